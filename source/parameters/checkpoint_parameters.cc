// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/checkpoint_parameters.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/parameters/read_parameters.h"
#include "signorini/parameters/section_reader.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
void declare_checkpoint(Declarations &declarations, const DeclarationScope &scope)
{
  if (!scope.includes("Checkpoint"))
    return;
  SubsectionDeclaration section(
      declarations, "Checkpoint",
      "Saves now and then, and when the run is interrupted, all that it needs to go on "
      "by 'signorini --resume'.");
  section.add("Interval", number_from(0.), "600", "s",
              "Run time from one checkpoint to the next; 0: one after each step.");
}

CheckpointParameters read_checkpoint(const ParameterText &text, const Declarations &in_use)
{
  return {SectionReader(text, in_use, "Checkpoint", 3).number("Interval")};
}

void check_checkpoint(const ParameterText &text, const Parameters &parameters)
{
  if (!parameters.checkpoint)
    return;
  const auto reject =
      [&text](bool is_there, const std::string &name, const std::string &where, const std::string &reason)
  {
    if (is_there)
      throw InputError(Complaint(fmt::format("'Checkpoint' contradicts {}: {}", name, reason))
                           .at(text.where("Checkpoint"))
                           .found(fmt::format("{} stands at {}", name, where))
                           .advise("remove one of the two"));
  };
  const std::string not_yet = "they do not work together yet";
  reject(parameters.study.has_value(), "'Study'", text.where("Study"),
         "--resume makes those runs of a study again that are not finished");
  if (parameters.contact)
  {
    reject(parameters.contact->potential == ContactParameters::Potential::volume, "'Potential = volume'",
           text.where("Contact", "Potential"), not_yet);
    reject(parameters.contact->correction.has_value(), "'Contact/Correction'",
           text.where("Contact/Correction"), not_yet);
  }
  const bool is_quasi_static = std::holds_alternative<QuasiStaticParameters>(parameters.solver);
  const bool is_any_made_anew =
      std::any_of(parameters.bodies.begin(), parameters.bodies.end(),
                  [](const BodyParameters &body)
                  {
                    return body.mesh.cell_type == MeshParameters::CellType::tetrahedra &&
                           is_adaptable(body.mesh, /*is_in_motion=*/false);
                  });
  reject(parameters.adaptivity && is_quasi_static && is_any_made_anew, "'Adaptivity' of tetrahedra",
         text.where("Adaptivity"), "no checkpoint holds meshes that are made anew");
}

std::map<std::string, std::string> scene_entries(const ParameterText &text)
{
  std::map<std::string, std::string> entries;
  for (const Declaration &entry : declare_parameters(text, Extent::in_use).entries)
    if (entry.path != "Output" && entry.path != "Checkpoint" && entry.path != "Exact solution" &&
        entry.key != "End time")
      entries[join_path(entry.path, entry.key)] = text.value(entry.path, entry.key, entry.default_value);
  return entries;
}

void check_unchanged(const ParameterText &text, const std::map<std::string, std::string> &at_the_start)
{
  std::map<std::string, std::string> now = scene_entries(text);
  const auto value_in = [](const std::map<std::string, std::string> &entries, const std::string &name)
  {
    const auto entry = entries.find(name);
    return entry == entries.end() ? std::string("absent") : "'" + entry->second + "'";
  };
  std::map<std::string, std::string> names = now;
  names.insert(at_the_start.begin(), at_the_start.end());
  for (const auto &[name, ignored] : names)
    if (value_in(now, name) != value_in(at_the_start, name))
    {
      const std::size_t end_of_path = name.rfind('/');
      const std::string path = end_of_path == std::string::npos ? "" : name.substr(0, end_of_path);
      throw InputError(Complaint(fmt::format("'{}' is not what the run began with", name))
                           .at(text.where(path, name.substr(end_of_path + 1)))
                           .found(value_in(now, name))
                           .expected(value_in(at_the_start, name))
                           .advise("set it back: only 'Output', 'Checkpoint', 'Exact solution' and the end "
                                   "time may change; or "
                                   "run from the start, without --resume"));
    }
}
} // namespace signorini
