/// \file The contacts of a step: found on the outlines, matched with those of the step before.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact_properties.hpp>
#include <ddacontact/detection/contact_length.hpp>
#include <ddacontact/detection/corner_clearance.hpp>
#include <ddacontact/detection/nearby_pairs.hpp>
#include <ddacontact/detection/outline_table.hpp>

#include <functional>
#include <map>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace ddacontact {

/// Finds the contacts of each step and hands on what they carry from step to step.
class ContactBuilder {
 public:
  /// \param[in] blocks  in their reference positions; must outlive the builder
  ContactBuilder(const BlockSystem& blocks, ContactProperties properties);

  /// The contacts of the start: those that touch (within 1e-6 of the block size) begin closed and bonded, and
  /// an overlap is taken as stress-free. Joints with a stiffness bear the stress of their blocks at once.
  /// \param[in] motion  see `build`
  /// \param[in] coming  blocks that come in among others that have moved, whose contacts alone count then:
  ///   what is flush to `default_lip` touches, the gap between is filled, and they begin without forces
  std::vector<Contact> build_first(const BlockState& state, const VectorXd& motion,
                                   const std::vector<double>& search_margin,
                                   const std::vector<int>& coming = {});
  /// Writes into `contacts` those that may close while no vertex of block b moves further than
  /// search_margin[b]. Those also in `previous` carry on its history; so does a vertex that slid
  /// onto the next edge where that is collinear, or across a corner onto the neighbour's vertex.
  /// \param[in] motion  displacements of all unknowns predicted for the step: of lines that a corner may meet
  ///   they tell which
  void build(const BlockState& state, const VectorXd& motion, const std::vector<double>& search_margin,
             const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts);
  /// Whether some corner may meet more than one line: contacts built last depend on the motion.
  bool has_choices() const { return !choices_.empty(); }
  /// Numbers of the doubtful contacts among those built last: they bear more than `least_force` (N per m) in
  /// a solution of the step although nothing told that their corner could not go the other way. With them the
  /// others of the same two blocks that nothing told of.
  /// \param[in] kept_too  that it was closed before does not tell either, but where it was asked so before and
  ///   has not slipped since
  std::vector<int> find_doubtful(std::vector<Contact>& contacts, double least_force, bool kept_too);
  /// Chooses the lines that corners meet anew, by the motion of a solution. False: the contacts are the same.
  bool choose_again(const BlockState& state, const VectorXd& motion,
                    const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts);
  /// Chooses the lines of doubtful contacts by the motion without them, for the rest of the step. A corner
  /// that was closed on a line before stays there as it did when contacts were built. False: they are the
  /// same.
  bool decide_doubtful(const BlockState& state, const VectorXd& without,
                       const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts);
  /// Restores a contact to what it was before a trial step.
  void restart(Contact& contact) const;
  /// Takes the positions of the vertex and the edge in a state as those at the start of the step.
  void start_from(const BlockState& state, std::vector<Contact>& contacts) const;
  const ContactProperties& properties() const { return properties_; }
  /// Whether pairs of blocks are looked for with a margin and kept while they may be; the same contacts
  /// either way.
  void keep_pairs(bool keep) { keeps_pairs_ = keep; }
  /// How often pairs of blocks were looked for.
  long n_searches() const { return nearby_.n_searches(); }

  /// Looks for missed penetrations: vertices that went into another block through an edge from `start` to
  /// `end`, deeper than the lip, and had none of these contacts, the last ones built, with it. False: there
  /// are none.
  bool find_missed(const BlockState& start, const BlockState& end, const std::vector<Contact>& contacts);
  /// Adds to the same contacts, as they are in `start`, those of the vertices found; the lines that corners
  /// of these blocks meet are not chosen again until contacts are built anew.
  void add_missed(const BlockState& start, std::vector<Contact>& contacts);

  /// Sets the joints that contacts, and their bonds, follow from now on.
  void set_joints(JointTable joints) { properties_.joints = std::move(joints); }

  /// The size tolerances are relative to: of the smaller block, held blocks not counted.
  double pair_size(int a, int b) const;

 private:
  /// Distance behind an edge's line at which a corner passes it, m: the lip, and for blocks that do not touch
  /// yet the closure of their other joints by their stiffness, as this one will close.
  double lip(int a, int b, bool touch) const;
  /// Finds the vertices and edges that may meet while no vertex of block b moves more than search_margin[b],
  /// ordered by the pairs of blocks; those of `previous` win ties. How many there are.
  std::size_t detect(const BlockState& state, const VectorXd& motion,
                     const std::vector<double>& search_margin, const std::vector<ContactRecord>& previous);
  /// Outlines and boxes of the blocks; the pairs of those that may meet.
  void find_pairs(const BlockState& state);
  /// How far the corners of blocks are from others, where their arcs reach those.
  void find_clearances(const BlockState& state);
  /// Radius with which a block meets the corner v of block b, m: 0 where another one goes on from there.
  double met_radius(int b, int v, int by) const;
  /// Appends the contacts of a pair, and where they were preferred to others.
  void find_contacts_of(const Pair& pair, const BlockState& state, const VectorXd& motion,
                        std::span<const ContactRecord> previous, FoundContacts& found) const;
  /// Leaves out the contacts whose forces no one can tell, or that stand for no length yet.
  void leave_out_idle(const Pair& pair, const BlockState& state, std::span<const ContactRecord> previous,
                      std::vector<VertexEdge>& found, std::size_t first) const;
  /// Finds where held blocks lie on edges of each other, as near as joints are flush: they are one ground.
  void find_covered(const BlockState& state);
  std::span<const CoveredPart> covered_of(const Pair& pair) const;
  /// Whether free unknowns move what has this form, by more than supports leave at the held end of an edge.
  bool is_moved(const Contact& contact, const VertexEdgeForm& by) const;
  /// Where supports alone hold two blocks together no one can tell the normal force: a bond bears shear by
  /// its cohesion alone.
  void leave_out_friction(Contact& contact) const;
  /// Whether free unknowns move the vertex off the edge, or along it where a bond bears that. Where only
  /// supports do, as at a held end of the edge, there is nothing to solve: the force between them is theirs.
  bool can_change(const BlockState& state, const VertexEdge& pair,
                  std::span<const ContactRecord> previous) const;
  bool choose_anew(const std::set<Pair>& pairs, const BlockState& state, const VectorXd& motion,
                   const std::vector<ContactRecord>& previous, std::vector<Contact>& contacts);
  /// Relation of a contact to one of the step before, the nearest first: the same; its vertex with an edge
  /// that is collinear with its own; where vertex meets vertex, the other vertex with this one's edge.
  enum class Kinship { same, collinear, exchanged, none };
  Kinship kinship(const BlockState& state, const VertexEdge& old, const VertexEdge& pair) const;
  /// The contact of `pair` with the history of its predecessor.
  ///
  /// \param[in] found     the contacts of its blocks, this one among them
  /// \param[in] previous  those of the step before
  Contact carry_over(const BlockState& state, const VertexEdge& pair, std::span<const VertexEdge> found,
                     std::span<const ContactRecord> previous) const;
  /// The closed contact of the step before whose history this one carries on: one has one successor, the
  /// nearest and of those the first, so that no bond holds twice.
  const ContactRecord* find_predecessor(const BlockState& state, const VertexEdge& pair,
                                        std::span<const VertexEdge> found,
                                        std::span<const ContactRecord> previous) const;
  /// \param[in] found   the contacts of its blocks
  /// \param[in] normal  its force at the end of the last step
  Contact make_contact(const BlockState& state, const VertexEdge& pair, std::span<const VertexEdge> found,
                       double normal = 0) const;
  /// A joint with a stiffness bears from the start the stress of its blocks, the mean of those that can move.
  void load_joint(const BlockState& state, Contact& contact) const;
  /// Closes and bonds a contact that touches.
  /// \param[in] comes_in  one of its blocks does
  void begin(const BlockState& state, std::span<const VertexEdge> found, bool comes_in,
             Contact& contact) const;
  /// Length over which the stresses of a contact act: that of `contact_length`, of joints with a stiffness or
  /// a strength in compression at any angle.
  /// \param[in] bears  whether a vertex of a block counts as a neighbour along the face
  ContactLength length_of(const BlockState& state, const VertexEdge& pair,
                          const std::function<bool(int block, int vertex)>& bears) const;
  /// Test whether a vertex of a block has one of these contacts.
  static std::function<bool(int, int)> bearing(std::span<const VertexEdge> found);
  /// Writes the length into the history of the contact, and apart the part of it on another joint.
  void set_length(const BlockState& state, std::span<const VertexEdge> found, ContactRecord& contact) const;
  /// Writes the part of the length on another joint. Where a vertex of the other face is near either may bear
  /// the force: the joints that a vertex meets are those between its neighbours on its own face.
  void set_length_beyond(const BlockState& state, ContactRecord& contact) const;
  /// Whether two contacts are of the same two faces and of one place along them, where a vertex of either
  /// lies on a vertex of the other: together they would stand for the faces twice. The search tells them apart
  /// but for joints with a stiffness, which strains move apart, and rounded blocks.
  bool are_at_one_place(const BlockState& state, const VertexEdge& a, const VertexEdge& b) const;
  /// Leaves one of contacts at one place: one that was closed, then one that lies along the other face, then
  /// one of a corner, where faces end.
  void leave_one_a_place(const BlockState& state, std::span<const ContactRecord> previous,
                         std::vector<VertexEdge>& found, std::size_t first) const;
  /// Glues a contact of a glued joint that is closed or touches: it sticks where it is. The gap of one that
  /// only touches counts as none from then on, so that glue adds no force.
  void glue(Contact& contact) const;
  /// False: no vertex of a is as deep in the box of b, which is in boxes_, as one that went into b.
  bool may_penetrate(int a, int b, const BlockState& end) const;
  /// Outline that the vertices of others may not enter, and whose vertices may not enter others: with rounded
  /// corners that of the centres of the circles.
  Points contact_outline(const BlockState& state, int block) const;

  const BlockSystem& blocks_;
  ContactProperties properties_;
  std::vector<double> half_width_, size_;  ///< of each block
  bool keeps_pairs_ = true;
  bool begins_ = false;  ///< contacts have none before them

  OutlineTable outlines_;
  std::map<int, std::vector<CoveredPart>> covered_;  ///< of the blocks that have some
  bool knows_covered_ = false;
  NearbyPairs nearby_;
  std::vector<CornerClearance> clearances_;  ///< of all points, where corners are rounded
  std::vector<Box> boxes_;
  std::vector<double> margins_;
  std::vector<Pair> pairs_;              ///< of blocks that may meet
  std::vector<double> closure_;          ///< of the joints of each block by their stiffness, largest, m
  std::vector<double> search_margin_;    ///< of the last search, with the rise by dilation, m
  std::vector<FoundContacts> found_in_;  ///< by `detect`, in each range of pairs
  std::vector<Choice> choices_;          ///< of all
  std::set<Pair> doubtful_;
  bool asks_kept_ = false;  ///< doubtful ones were looked for among those that were closed before, too
  std::vector<std::size_t> first_found_;  ///< of each range, among all
  std::vector<VertexEdge> missed_;
};

}  // namespace ddacontact
