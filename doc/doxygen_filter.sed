# Doxygen takes what follows \file for a name. Line numbers are kept from #pragma once on.
s|^/// \\file \(.*\)|/// \\file\n/// \1|
/^#pragma once$/d
