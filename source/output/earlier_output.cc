// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/earlier_output.h"

#include "signorini/base/exceptions.h"

#include <filesystem>
#include <regex>
#include <vector>

namespace signorini
{
namespace
{
void remove_checkpoints(const std::filesystem::path &folder)
{
  namespace files = std::filesystem;
  static const std::regex own("rank_[0-9]+");
  std::error_code failure;
  // First that which points to them: what is left of them then counts for nothing.
  files::remove(folder / "last", failure);
  if (failure)
    throw FileError("cannot remove '" + (folder / "last").string() + "' of an earlier run");
  for (const char *slot : {"0", "1"})
  {
    std::vector<files::path> earlier;
    for (const files::directory_entry &entry : files::directory_iterator(folder / slot, failure))
      if (std::regex_match(entry.path().filename().string(), own))
        earlier.push_back(entry.path());
    for (const files::path &path : earlier)
      files::remove(path, failure);
    files::remove(folder / slot, failure);
  }
  files::remove(folder, failure);
}
} // namespace

void remove_earlier_output(const std::string &directory)
{
  namespace files = std::filesystem;
  const files::path folder(directory);
  if (!files::exists(folder / "log.txt") || !files::exists(folder / "parameters.prm"))
    return;
  static const std::regex own(
      "summary\\.json|profile\\.csv|study\\.csv|report\\.html|solution\\.pvd|"
      "report_(scene|growth|contact_pressure|contact_force|largest_pressure|penetration|energy|support_force|"
      "contact_area|estimated_error|run_time|error_time|error_dofs|memory)\\.png|"
      "solution_[0-9]{4,}(\\.pvtu|\\.[0-9]+\\.vtu)");
  std::vector<files::path> earlier;
  std::error_code failure;
  for (const files::directory_entry &entry : files::directory_iterator(folder, failure))
    if (std::regex_match(entry.path().filename().string(), own) && !entry.is_directory())
      earlier.push_back(entry.path());
  for (const files::path &path : earlier)
    if (!files::remove(path, failure))
      throw FileError("cannot remove '" + path.string() + "' of an earlier run");
  if (files::is_directory(folder / "checkpoint", failure))
    remove_checkpoints(folder / "checkpoint");
}
} // namespace signorini
