/// \file What summary.json tells of a run: how it went and what it cost.
#pragma once

#include "answer.hpp"

#include <ddacontact/output/summary_reader.hpp>

namespace dda {

void tell_outcome(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_rest(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_warnings(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_size(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_work(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_impacts(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_energy(Answer& answer, const ddacontact::SummaryTable& summary);
void tell_times(Answer& answer, const ddacontact::SummaryTable& summary);

}  // namespace dda
