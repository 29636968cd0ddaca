// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/file_content.h"

#include "signorini/base/exceptions.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace signorini
{
std::string ending_of(const std::string &path)
{
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](const unsigned char character) { return std::tolower(character); });
  return ending;
}

std::string read_content(const std::string &path)
{
  std::error_code ignored;
  std::ifstream stream(path, std::ios::binary);
  if (!std::filesystem::is_regular_file(path, ignored) || !stream)
    throw FileError(
        Complaint("the mesh file cannot be read")
            .at(path)
            .advise("give the name of an existing file; it is looked for beside the parameter file"));
  std::ostringstream content;
  content << stream.rdbuf();
  return content.str();
}
} // namespace signorini
