/// \file The programs that make the pages: all chapters, or one.
#pragma once

#include "report.hpp"

#include <span>
#include <string>

namespace verification {

/// A part of a page.
struct Chapter {
  const char* name;  ///< that it is requested by
  void (*write)(Report&);
  bool on_request = false;  ///< only on request: it takes long
};

/// `PAGE_verification DIRECTORY [chapter]`: writes DIRECTORY/PAGE.md and its pictures. Returns the exit
/// status. \param[in] front      how the page begins; its two {} are the numbers of claims and of those seen
/// \param[in] claims_of  the header of what is said
int make_page(int argc, char** argv, const std::string& page, const char* front,
              std::span<const Chapter> chapters, const char* claims_of = "requirement");

}  // namespace verification
