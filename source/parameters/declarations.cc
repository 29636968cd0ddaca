// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/declarations.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/read_mesh_file.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
const Declaration *Declarations::find(const std::string &path, const std::string &key) const
{
  const auto found =
      std::find_if(entries.begin(), entries.end(),
                   [&](const Declaration &entry) { return entry.path == path && entry.key == key; });
  return found == entries.end() ? nullptr : &*found;
}

bool Declarations::has_subsection(const std::string &path) const
{
  return std::any_of(subsections.begin(), subsections.end(),
                     [&path](const DeclaredSubsection &other) { return other.path == path; });
}

SubsectionDeclaration::SubsectionDeclaration(Declarations &all, const std::string &subsection,
                                             const std::string &text)
    : declarations(all), path(subsection)
{
  if (!path.empty())
    declarations.subsections.push_back({path, text});
}

void SubsectionDeclaration::add(const std::string &key, const ValueRange &range,
                                const std::string &default_value, const std::string &unit,
                                const std::string &text)
{
  declarations.entries.push_back({path, key, range, default_value, unit, text, false});
}

void SubsectionDeclaration::add_required(const std::string &key, const ValueRange &range,
                                         const std::string &unit, const std::string &text)
{
  declarations.entries.push_back({path, key, range, "", unit, text, true});
}

bool DeclarationScope::includes(const std::string &path) const
{
  return extent == Extent::everything || text.find_subsection(path) != nullptr;
}

bool DeclarationScope::chosen(const std::string &path, const std::string &key, const std::string &choice,
                              const std::string &default_choice) const
{
  return extent == Extent::everything || text.value(path, key, default_choice) == choice;
}

std::string DeclarationScope::components(const std::string &three) const
{
  std::vector<std::string> parts = split(three, ',');
  parts.resize(dimension);
  return join(parts, ", ");
}

ValueRange DeclarationScope::vector() const
{
  return list_of(any_number(), dimension, 3);
}

namespace
{
/// The valid name that was probably meant: the same key elsewhere, or the most similar one in the same
/// subsection.
std::string nearest_entry(const ParameterEntry &entry, const Declarations &everything)
{
  std::vector<std::string> neighbours;
  std::vector<std::string> namesakes;
  for (const Declaration &declaration : everything.entries)
  {
    if (declaration.path == entry.path)
      neighbours.push_back(declaration.key);
    if (edit_distance(declaration.key, entry.key) == 0)
      namesakes.push_back(join_path(declaration.path, declaration.key));
  }
  const std::string full_name = join_path(entry.path, entry.key);
  const std::string neighbour = nearest_name(entry.key, neighbours);
  if (!namesakes.empty() && (neighbour.empty() || edit_distance(neighbour, entry.key) > 0))
    return *std::min_element(namesakes.begin(), namesakes.end(),
                             [&](const std::string &a, const std::string &b)
                             { return edit_distance(a, full_name) < edit_distance(b, full_name); });
  return neighbour.empty() ? "" : join_path(entry.path, neighbour);
}

void check_name(const ParameterSubsection &subsection, const Declarations &everything)
{
  if (everything.has_subsection(subsection.path))
    return;
  std::vector<std::string> siblings;
  for (const DeclaredSubsection &other : everything.subsections)
    if (ParameterSubsection{other.path, "", 0}.parent() == subsection.parent())
      siblings.push_back(ParameterSubsection{other.path, "", 0}.name());
  const std::string nearest = nearest_name(subsection.name(), siblings);
  throw InputError(
      Complaint(fmt::format("there is no subsection '{}'", subsection.path))
          .at(subsection.where())
          .expected(siblings.empty() ? "no subsections here" : "one of " + join(siblings, ", "))
          .did_you_mean(nearest.empty() ? "" : join_path(subsection.parent(), nearest))
          .advise("correct or remove the subsection; bodies and obstacles must be named in 'Bodies' and "
                  "'Obstacles'"));
}

void check_name(const ParameterEntry &entry, const Declarations &everything)
{
  if (everything.find(entry.path, entry.key) != nullptr)
    return;
  std::vector<std::string> keys;
  for (const Declaration &declaration : everything.entries)
    if (declaration.path == entry.path)
      keys.push_back(declaration.key);
  throw InputError(Complaint(fmt::format("there is no entry '{}' {}", entry.key,
                                         entry.path.empty() ? "at the top level" : "in '" + entry.path + "'"))
                       .at(entry.where())
                       .found(entry.value)
                       .expected(keys.empty() ? "no entries here" : "one of " + join(keys, ", "))
                       .did_you_mean(nearest_entry(entry, everything))
                       .advise("correct the name or remove the entry"));
}

void check_value(const ParameterEntry &entry, const Declaration &declaration)
{
  const bool absent = entry.value.empty() && declaration.default_value.empty();
  if (absent || declaration.range.contains(entry.value))
    return;
  throw InputError(
      Complaint(fmt::format("the value of '{}' is not allowed", join_path(entry.path, entry.key)))
          .at(entry.where())
          .found(entry.value.empty() ? "nothing" : "'" + entry.value + "'")
          .expected(declaration.range.description() +
                    (declaration.unit.empty() ? "" : " [" + declaration.unit + "]"))
          .did_you_mean(nearest_name(entry.value, declaration.range.choices))
          .advise(declaration.unit.empty() ? "correct the value"
                                           : "correct the value; write numbers without their unit"));
}

void check_required(const ParameterText &text, const Declaration &declaration)
{
  if (!declaration.required || !text.value(declaration.path, declaration.key).empty())
    return;
  throw InputError(Complaint(fmt::format("'{}' is missing", join_path(declaration.path, declaration.key)))
                       .at(text.where(declaration.path))
                       .expected(declaration.range.description() +
                                 (declaration.unit.empty() ? "" : " [" + declaration.unit + "]"))
                       .advise(fmt::format("add 'set {} = …' there: {}", declaration.key, declaration.text)));
}

/// The choice that decides which entries belong to a subsection.
std::string deciding_choice(const ParameterText &text, const Declarations &in_use, const std::string &path)
{
  for (const std::string key : {"Shape", "Case", "Model"})
    if (const Declaration *const declaration = in_use.find(path, key))
    {
      std::string choice = fmt::format("{} = {}", key, text.value(path, key, declaration->default_value));
      for (const std::string further : {"Cell type", "File"})
        if (const ParameterEntry *const entry = text.find(path, further))
          choice += fmt::format(", {} = {}", further, entry->value);
      return choice;
    }
  if (path == "Adaptivity")
    for (const std::string run : {"Explicit", "Implicit", "Quasi-static"})
      if (in_use.has_subsection(run))
        return fmt::format("'{}'", run);
  return "the dimension";
}
} // namespace

void check_names_and_values(const ParameterText &text, const Declarations &everything)
{
  // The names of bodies and obstacles first: which subsections are valid follows from them.
  for (const ParameterEntry &entry : text.entries)
    if (entry.path.empty())
    {
      check_name(entry, everything);
      check_value(entry, *everything.find(entry.path, entry.key));
    }
  for (const Declaration &declaration : everything.entries)
    if (declaration.path.empty())
      check_required(text, declaration);
  for (const ParameterSubsection &subsection : text.subsections)
    check_name(subsection, everything);
  for (const ParameterEntry &entry : text.entries)
    check_name(entry, everything);
  for (const ParameterEntry &entry : text.entries)
    check_value(entry, *everything.find(entry.path, entry.key));
}

void check_presence(const ParameterText &text, const Declarations &in_use)
{
  for (const ParameterEntry &entry : text.entries)
    if (in_use.find(entry.path, entry.key) == nullptr)
    {
      const bool has_mesh_of_file =
          text.value(entry.path, "Shape") == "file" && is_mesh_file(text.value(entry.path, "File"));
      throw InputError(
          Complaint(fmt::format("'{}' contradicts {}, which has no such entry{}",
                                join_path(entry.path, entry.key), deciding_choice(text, in_use, entry.path),
                                has_mesh_of_file ? ": a mesh from a file is taken as it is" : ""))
              .at(entry.where())
              .found(entry.value)
              .advise(has_mesh_of_file
                          ? fmt::format("remove '{}', and make the mesh as is needed where it was made",
                                        entry.key)
                          : "remove one of the two"));
    }
  for (const Declaration &declaration : in_use.entries)
    check_required(text, declaration);
}
} // namespace signorini
