// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/exact_solution_parameters.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/expression.h"
#include "signorini/parameters/scene_needs.h"
#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

namespace signorini
{
namespace
{
/// A number that an exact solution needs.
struct ExactSolutionKey
{
  std::string key;
  ValueRange range;
  std::string default_value; ///< empty: required
  std::string unit;
  std::string text;
};

/// A known exact solution, its numbers, the scenes it holds for, and what it is compared in.
struct ExactSolutionCase
{
  std::string name;
  std::vector<ExactSolutionKey> keys;
  std::vector<SceneNeed> needs;
  std::vector<std::string> quantities; ///< names of the rows that compute_errors() makes
};

constexpr const char *displacement_key = "Displacement";

const std::vector<ExactSolutionCase> &exact_solutions()
{
  static const ExactSolutionKey radius{
      "Radius", positive_length(), "", "m",
      "Hertz, Ball impact: radius of the round body, for two round bodies the effective "
      "one 1/(1/R1 + 1/R2); must agree with the meshes within 1e-6."};
  static const ExactSolutionKey fraction{
      "Fraction of the contact", number_above_up_to(0., 1.), "1", "",
      "Hertz: share of the contact that is modelled, such as 0.25 for a quarter."};
  static const ExactSolutionKey pressure{
      "Pressure", positive_number(), "", "Pa",
      "Patch: uniform contact pressure; must be that of the loads at the end time."};
  static const ExactSolutionKey normal_force{
      "Normal force", positive_number(), "", "N",
      "Sliding contact: the constant force on the second body along the last axis."};
  static const ExactSolutionKey period{"Period", positive_number(), "", "s",
                                       "Friction loop: time of a loop of the load; the last one counts."};
  using Shape = ObstacleParameters::Shape;
  static const SceneNeed fixed_planes = fixed_obstacles("obstacles that are fixed planes", {Shape::plane});
  static const SceneNeed round_or_plane =
      fixed_obstacles("obstacles that are fixed planes or spheres", {Shape::plane, Shape::sphere});
  static const std::string profile = "pressure profile (relative L2 distance)";
  static const std::vector<ExactSolutionCase> table{
      {"Hertz sphere",
       {radius, fraction},
       {dimension_equal_to(3), one_touching_pair(), round_or_plane, contact(), surface_potential(),
        matching_radius()},
       {"peak pressure", "contact radius", "contact area", "approach", profile}},
      {"Hertz cylinder",
       {radius, fraction},
       {dimension_equal_to(2), one_touching_pair(), round_or_plane, contact(), surface_potential(),
        matching_radius()},
       {"peak pressure", "contact radius", "contact area", profile}},
      {"Squeezed bars",
       {},
       {quasi_static_run(), number_of_bodies(2), boxes_only(), number_of_obstacles(0), contact(),
        surface_potential(), shifts_only()},
       {"estimated contact error", "penetration over shortening of the surface layers",
        "contact resultant against the load", "displacement of the loaded end"}},
      {"Patch",
       {pressure},
       {quasi_static_run(), number_of_bodies(2), contact(), a_load(), matching_pressure()},
       {"contact pressure (worst point)", "projected contact pressure (worst node)",
        "normal stress (largest)", "normal stress (smallest)", "resultant",
        "other stresses over the pressure"}},
      {"Sliding contact",
       {normal_force},
       {quasi_static_run(), number_of_bodies(2), number_of_obstacles(0), contact()},
       {"mean normal force", "ripple of the normal force", "largest tangential force over the normal one"}},
      {"Bar impact",
       {},
       {run_in_motion(), number_of_bodies(2), equal_boxes(), number_of_obstacles(0), contact(), shifts_only(),
        no_viscosity()},
       {"momentum exchange (velocity)", "mechanical energy", "contact time",
        "peak contact force (dashpots included)"}},
      {"Ball impact",
       {radius},
       {dimension_equal_to(3), run_in_motion(), one_touching_pair(), round_or_plane, contact(),
        surface_potential(), matching_radius()},
       {"peak contact force", "contact time", "mechanical energy"}},
      {"Bounce",
       {},
       {run_in_motion(), number_of_bodies(1), boxes_only(), number_of_obstacles(1), fixed_planes,
        contact_damping(), hexahedra_only(), no_grading(), no_viscosity()},
       {"restitution", "impulse of the obstacle", "dissipated energy"}},
      {"Rough plane",
       {},
       {run_in_motion(), number_of_bodies(1), boxes_only(), number_of_obstacles(1), fixed_planes,
        contact_friction(), shifts_only(), sliding_on_a_line()},
       {"way along the plane", "energy rubbed off"}},
      {"Friction loop",
       {period},
       {quasi_static_run(), number_of_bodies(1), boxes_only(), number_of_obstacles(1), fixed_planes,
        contact_friction(), shifts_only(), linear_elastic_bodies(), no_transverse_contraction(), a_load()},
       {"energy rubbed off in a loop", "displacement of the loaded end"}},
      {"Displacement",
       {},
       {quasi_static_run(), linear_elastic_bodies()},
       {"displacement (relative L2 distance)", "strain (relative distance in the energy norm)",
        "estimated discretization error"}}};
  return table;
}

const ExactSolutionCase *find_case(const std::string &name)
{
  for (const ExactSolutionCase &entry : exact_solutions())
    if (entry.name == name)
      return &entry;
  return nullptr;
}

std::vector<std::string> exact_solution_names()
{
  std::vector<std::string> names;
  for (const ExactSolutionCase &entry : exact_solutions())
    names.push_back(entry.name);
  return names;
}

std::string list_needs(const ExactSolutionCase &entry)
{
  std::vector<std::string> needs;
  for (const SceneNeed &need : entry.needs)
    needs.push_back(need.text);
  return join(needs, "; ");
}
} // namespace

std::vector<std::string> exact_solution_quantities(const std::string &name)
{
  return find_case(name)->quantities;
}

void declare_exact_solution(Declarations &declarations, const DeclarationScope &scope)
{
  const std::string path = "Exact solution";
  if (!scope.includes(path))
    return;
  SubsectionDeclaration section(declarations, path, "What the result is measured against.");
  std::string needs;
  for (const ExactSolutionCase &entry : exact_solutions())
    needs += fmt::format(" {} needs {}.", entry.name, list_needs(entry));
  section.add_required("Case", one_of(exact_solution_names()), "", "Name of the exact solution." + needs);
  if (scope.chosen(path, "Case", "Displacement", ""))
    section.add_required(
        displacement_key, any_text(), "m",
        "Displacement: the exact one of all bodies, a formula of x, y, z, t for each component, "
        "separated by ';'.");
  for (const ExactSolutionCase &entry : exact_solutions())
    for (const ExactSolutionKey &key : entry.keys)
    {
      if (!scope.chosen(path, "Case", entry.name, "") || declarations.find(path, key.key) != nullptr)
        continue;
      if (key.default_value.empty())
        section.add_required(key.key, key.range, key.unit, key.text);
      else
        section.add(key.key, key.range, key.default_value, key.unit, key.text);
    }
}

ExactSolutionParameters read_exact_solution(const ParameterText &text, const Declarations &in_use,
                                            unsigned int dimension)
{
  const SectionReader section(text, in_use, "Exact solution", dimension);
  ExactSolutionParameters exact;
  exact.name = section.value("Case");
  for (const ExactSolutionKey &key : find_case(exact.name)->keys)
    exact.values[key.key] = section.number(key.key);
  if (exact.name == "Displacement")
    exact.displacement = section.formulas(displacement_key);
  for (const std::string &formula : exact.displacement)
    try
    {
      Expression{formula};
    }
    catch (const InputError &error)
    {
      throw InputError(Complaint(error.complaint()).at(section.place(displacement_key)).found(formula));
    }
  return exact;
}

void check_exact_solution(const ParameterText &text, const Parameters &parameters)
{
  if (!parameters.exact_solution)
    return;
  const ExactSolutionCase &entry = *find_case(parameters.exact_solution->name);
  for (const SceneNeed &need : entry.needs)
    if (const auto fault = need.find_fault(text, parameters))
      throw InputError(
          Complaint(fmt::format("exact solution '{}' needs {}", entry.name, need.text))
              .at(fault->where)
              .found(fault->found)
              .expected(list_needs(entry))
              .advise(fmt::format("change the scene, or the case at {}, or remove 'Exact solution'",
                                  text.where("Exact solution", "Case"))));
}
} // namespace signorini
