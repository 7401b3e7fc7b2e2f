/// \file The contacts of a step: found on the outlines, matched with those of the step before.
#pragma once

#include <ddacontact/block/block_system.hpp>
#include <ddacontact/contact/contact.hpp>
#include <ddacontact/contact/joint_table.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/detection/broad_phase.hpp>

#include <span>
#include <vector>

namespace ddacontact {

/// What contacts are made of, apart from geometry.
struct ContactProperties {
  double normal_stiffness = 0;      ///< p, N/m per m
  double tangential_stiffness = 0;  ///< p bar, N/m per m
  JointTable joints;
  std::vector<int> materials;  ///< of each block
  ContactMethod method = ContactMethod::classic;
  double penetration_tolerance = 0;  ///< of the block size; 0: plain penalty
};

/// Finds the contacts of each step and hands on what they carry from step to step.
class ContactBuilder {
 public:
  /// \param[in] blocks  in their reference places; must outlive the builder
  ContactBuilder(const BlockSystem& blocks, ContactProperties properties);

  /// The contacts of the start: those that touch (within 1e-6 of the block size) begin closed and bonded, and
  /// an overlap is taken as stress-free.
  std::vector<Contact> build_first(const BlockState& state, const std::vector<double>& reach);
  /// The contacts that may close while no vertex of block b moves further than reach[b]. Those also in
  /// `previous` carry on its history; so does a vertex that slid straight on onto the next edge, or across a
  /// corner onto the neighbour's vertex.
  std::vector<Contact> build(const BlockState& state, const std::vector<double>& reach,
                             const std::vector<Contact>& previous);
  /// Adds to the contacts of `start`, the last ones built, those of vertices that went into another block
  /// through an edge on the way to `end`, deeper than 1e-5 of the block size, and had no contact with it.
  /// False: there are none.
  bool add_entered(const BlockState& start, const BlockState& end, std::vector<Contact>& contacts);

  /// From now on contacts follow these joints, the bonds of `contacts` too.
  void set_joints(JointTable joints, std::vector<Contact>& contacts);

  /// The size tolerances are relative to: of the smaller block, held blocks not counted.
  double pair_size(int a, int b) const;

 private:
  /// The vertices and edges that may meet while no vertex of block b moves further than reach[b], ordered by
  /// the pairs of blocks; of `previous` those that are closed win ties. Valid until the next call.
  const std::vector<VertexEdge>& detect(const BlockState& state, const std::vector<double>& reach,
                                        const std::vector<Contact>& previous);
  /// The closed contact of the step before whose history this one carries on: the same, or that of the same
  /// vertex with an edge that goes straight on into this one, or, where vertex meets vertex, the one that the
  /// other vertex made with this vertex's edge.
  const Contact* find_predecessor(const BlockState& state, const VertexEdge& pair,
                                  std::span<const Contact> previous) const;
  Contact make_contact(const BlockState& state, const VertexEdge& pair) const;
  /// Everything but the bond.
  void set_law(Contact& contact) const;
  /// Of a bonded contact, over its length.
  void set_bond_strength(Contact& contact) const;
  const JointStrength& strength(const VertexEdge& pair) const {
    return properties_.joints.between(properties_.materials[pair.vertex_block],
                                      properties_.materials[pair.edge_block]);
  }
  void make_forms(Contact& contact) const;
  MovingVertexEdge motion(const BlockState& state, const VertexEdge& pair) const;

  const BlockSystem& blocks_;
  ContactProperties properties_;
  std::vector<double> half_width_;  ///< of each block

  // Working arrays of `detect`.
  BroadPhase broad_phase_;
  std::vector<Box> boxes_;
  std::vector<Pair> pairs_;  ///< of blocks that may meet
  std::vector<VertexEdge> found_, kept_;
  Points shifted_;
};

}  // namespace ddacontact
