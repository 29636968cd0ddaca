// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/file_content.h"

#include "signorini/base/exceptions.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>

namespace signorini
{
namespace
{
const std::string ending_of_packed = ".gz";

std::string last_ending(const std::filesystem::path &name)
{
  std::string ending = name.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](const unsigned char character) { return std::tolower(character); });
  return ending;
}

bool is_packed(const std::filesystem::path &name)
{
  return last_ending(name) == ending_of_packed && last_ending(name.stem()) == ".inp";
}
} // namespace

std::string ending_of(const std::string &path)
{
  const std::filesystem::path name = path;
  return last_ending(is_packed(name) ? name.stem() : name);
}

std::vector<std::string> possible_names(const std::string &path)
{
  if (is_packed(path))
    return {path, path.substr(0, path.size() - ending_of_packed.size())};
  if (ending_of(path) == ".inp")
    return {path, path + ending_of_packed};
  return {path};
}

std::string read_content(const std::string &path)
{
  std::error_code ignored;
  const bool is_file = std::filesystem::is_regular_file(path, ignored);
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(is_file ? gzopen(path.c_str(), "rb") : nullptr,
                                                        gzclose);
  if (!file)
    throw FileError(Complaint("the mesh file cannot be read")
                        .at(path)
                        .advise("give a file, not a folder, that may be read"));
  std::string content;
  std::array<char, 1 << 16> buffer;
  int n_read = 0;
  while ((n_read = gzread(file.get(), buffer.data(), buffer.size())) > 0)
    content.append(buffer.data(), static_cast<std::size_t>(n_read));
  if (n_read < 0)
    throw FileError(Complaint("the mesh file cannot be unpacked")
                        .at(path)
                        .advise("get it again: it is cut off or damaged"));
  return content;
}
} // namespace signorini
