/// \file A part of a run, as the stepper takes it.
#pragma once

#include <ddacontact/contact/contact_builder.hpp>
#include <ddacontact/core/options.hpp>
#include <ddacontact/core/rest_criterion.hpp>
#include <ddacontact/core/water.hpp>
#include <ddacontact/time/equilibrium.hpp>
#include <ddacontact/time/face_parts.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ddacontact {

/// Options, laws and changes of a part of a run. Plane, kinematics and preset of the analysis are those of
/// the whole run.
struct Stage {
  AnalysisOptions analysis;            ///< `steps` are those of this part
  JointTable joints;                   ///< of its contacts
  std::vector<int> removed;            ///< blocks taken out at its start
  bool reset_displacements = false;    ///< at its end: displacements are counted anew
  std::optional<RestCriterion> until;  ///< ends it with the first step that meets it
  std::string name;                    ///< for messages; may be empty
  Water water{};                       ///< relative to the model's origin
  std::vector<int> bolts{};            ///< installed at its start
  std::vector<int> added{};            ///< blocks that come in at its start, absent before
  int relax = 0;                       ///< steps in which the forces of `removed` decrease to nothing
  /// Loads that come in at its start.
  std::vector<PointLoad> point_loads{};
  std::vector<PressureLoad> pressure_loads{};
  std::vector<BodyLoad> body_loads{};

  bool has_new_loads() const {
    return !point_loads.empty() || !pressure_loads.empty() || !body_loads.empty();
  }
};

/// Takes out blocks and bolts that later stages bring in.
void remove_later(const std::vector<Stage>& stages, BlockSystem& blocks);
/// Changes the blocks as a stage does at its start: which are present, their bolts, and their loads.
/// \param[in] start_time  of the stage, s
/// \param[in] faces       of all blocks, if the stage has water
void change_blocks(const Stage& stage, double start_time, const std::vector<FacePart>& faces,
                   BlockSystem& blocks);

/// How a stage ended, or where it stands.
struct StageEnd {
  int stage = 0;              ///< its number
  long steps = 0;             ///< made in it
  double time = 0;            ///< at its end, s
  bool came_to_rest = false;  ///< its `until` came true
  bool at_rest = false;       ///< see Stepper::is_at_rest
  double exchanged = 0;       ///< the largest energy exchanged by then, J per m
  Equilibrium equilibrium;    ///< at its end
};

}  // namespace ddacontact
