/// \file Steps kept as text, to be made again alone.
#pragma once

#include <ddacontact/time/step_record.hpp>

#include <iosfwd>

namespace support {

/// Numbers in hexadecimal: read_record returns the same bits. For runs of one stage, all of whose blocks are
/// awake.
void write_record(std::ostream& out, const ddacontact::StepRecord& record);
/// Throws Error for what write_record has not written.
ddacontact::StepRecord read_record(std::istream& in);

}  // namespace support
