/// \file State and accounts of a run, from which it goes on as if it had never stopped.
#pragma once

#include <ddacontact/time/energy_ledger.hpp>
#include <ddacontact/time/run_warnings.hpp>
#include <ddacontact/time/stage.hpp>
#include <ddacontact/time/step_counts.hpp>
#include <ddacontact/time/step_record.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ddacontact {

/// Accounts of a run so far.
struct RunAccounts {
  StepCounts counts;
  EnergyLedger energy;
  double last_dt = 0;        ///< of the last accepted substep, s
  Points reactions;          ///< see Stepper::reactions
  std::vector<char> convex;  ///< outlines that have been so to this moment
  std::vector<std::string> notes;
  std::string last_unsettled;
  Equilibrium equilibrium;           ///< after the last substep
  std::vector<StageEnd> stage_ends;  ///< of the stages that are over
  RunWarnings warnings;
};

/// A step record with the accounts of the run; its contacts have their results too.
struct RunRecord : RunAccounts {
  StepRecord step;
  double end_time = 0;                ///< of ramps, s
  Points zero_position, zero_origin;  ///< points from which displacements count; empty: the start's
};

/// The bits of a record, in the order of bytes of the machine.
std::string to_bytes(const RunRecord& record);
/// The record of these bytes. Throws Error for bytes that to_bytes has not made.
RunRecord run_record_from(std::string_view bytes);

}  // namespace ddacontact
