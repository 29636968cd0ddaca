// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/read_parameters.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_expressions.h"
#include "signorini/parameters/body_parameters.h"
#include "signorini/parameters/checkpoint_parameters.h"
#include "signorini/parameters/contact_parameters.h"
#include "signorini/parameters/exact_solution_parameters.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/parameters/output_directory.h"
#include "signorini/parameters/run_parameters.h"
#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"
#include "signorini/parameters/study_parameters.h"

#include <fmt/format.h>

#include <algorithm>

namespace signorini
{
namespace
{
/// The dimension, before it has been checked.
unsigned int dimension_of(const ParameterText &text)
{
  return text.value("", "Dimension", "3") == "2" ? 2 : 3;
}

void declare_top_level(Declarations &declarations, const DeclarationScope &scope)
{
  SubsectionDeclaration top(declarations, "", "");
  top.add("Dimension", integer_from(2, 3), "3", "", "Three, or two for plane strain.");
  top.add("Degree", integer_from(1, 2), "1", "", "Polynomial degree of all elements.");
  top.add_required("Bodies", any_names(), "", "Names of the bodies; each has a subsection 'Body NAME'.");
  top.add("Obstacles", any_names(), "", "", "Names of the obstacles; each has a subsection 'Obstacle NAME'.");
  top.add("Gravity", scope.vector(), scope.components("0, 0, 0"), "m/s²",
          "Acceleration of all bodies; in 2-D two numbers, or three with the third 0.");
}

/// Throws unless the subsection is there.
void require(const ParameterText &text, const std::string &path, const std::string &reason,
             const std::string &where)
{
  if (text.find_subsection(path) == nullptr)
    throw InputError(
        Complaint(fmt::format("subsection '{}' is missing", path))
            .at(where)
            .found(reason)
            .advise(fmt::format("add 'subsection {}' … 'end'", ParameterSubsection{path, "", 0}.name())));
}

std::vector<std::string> names_of(const std::vector<BodyParameters> &bodies)
{
  std::vector<std::string> names;
  for (const BodyParameters &body : bodies)
    names.push_back(body.name);
  return names;
}

void check_subsections(const ParameterText &text, const SectionReader &top,
                       const std::vector<std::string> &bodies, const std::vector<std::string> &obstacles)
{
  for (const std::string &body : bodies)
  {
    const std::string path = "Body " + body;
    require(text, path, fmt::format("'{}' stands in 'Bodies'", body), top.complain("Bodies", "").where);
    require(text, path + "/Mesh", "every body has a mesh", text.where(path));
    require(text, path + "/Material", "every body has a material", text.where(path));
  }
  for (const std::string &obstacle : obstacles)
  {
    if (std::find(bodies.begin(), bodies.end(), obstacle) != bodies.end())
      throw InputError(top.complain("Obstacles", fmt::format("'{}' is a body and an obstacle", obstacle))
                           .advise("give one of them another name"));
    require(text, "Obstacle " + obstacle, fmt::format("'{}' stands in 'Obstacles'", obstacle),
            top.complain("Obstacles", "").where);
  }
  if (!obstacles.empty())
    require(text, "Contact", "there are obstacles, which no body can feel without contact",
            top.complain("Obstacles", "").where);
  else if (bodies.size() == 1 && text.find_subsection("Contact") != nullptr &&
           text.find_subsection("Body " + bodies.front() + "/Copies") == nullptr &&
           text.find("Contact", "Self-contact") == nullptr)
    throw InputError(
        Complaint("'Contact' has nothing to do: there is one body and no obstacle")
            .at(text.where("Contact"))
            .found(fmt::format("Bodies = {}", bodies.front()))
            .expected("at least two bodies, or an obstacle")
            .advise("add a name to 'Obstacles' with 'subsection Obstacle NAME', or one to 'Bodies' "
                    "with 'subsection Body NAME', or set 'Self-contact', or remove 'Contact'"));
}

/// Things that make no sense without inertia.
void check_quasi_static(const ParameterText &text, const Parameters &parameters)
{
  const auto reject = [&text](const std::string &path, const std::string &what)
  {
    if (text.find_subsection(path) != nullptr)
      throw InputError(Complaint(fmt::format("'{}' contradicts 'Quasi-static': {}", path, what))
                           .at(text.where(path))
                           .found("'Quasi-static' stands at " + text.where("Quasi-static"))
                           .advise("remove the subsection, or run 'Explicit'"));
  };
  for (const BodyParameters &body : parameters.bodies)
  {
    reject(body_subsection(body.name) + "/Initial motion", "without inertia there is no velocity");
    if (body.material.viscosity > 0.)
      throw InputError(Complaint("'Viscosity' contradicts 'Quasi-static': without velocity there is no "
                                 "resistance to it")
                           .at(text.where(body_subsection(body.name) + "/Material", "Viscosity"))
                           .found("'Quasi-static' stands at " + text.where("Quasi-static"))
                           .advise("remove the key, or run 'Explicit'"));
  }
  reject("Contact/Damping", "without velocity there is no damping");
}

/// Things that only an equilibrium has.
void check_equilibrium_only(const ParameterText &text, const Parameters &parameters)
{
  const std::string run = name_of(parameters.solver);
  const auto complain = [&](const std::string &what, const std::string &place)
  {
    return Complaint(fmt::format("{} contradicts '{}': it goes from equilibrium to equilibrium", what, run))
        .at(place)
        .found(fmt::format("'{}' stands at {}", run, text.where(run)));
  };
  if (parameters.contact && parameters.contact->correction)
    throw InputError(complain("'Contact/Correction'", text.where("Contact/Correction"))
                         .advise("remove the subsection, or run 'Quasi-static'"));
  if (parameters.contact && !parameters.contact->penalty_factor)
    throw InputError(complain("'Penalty factor = auto'", text.where("Contact", "Penalty factor"))
                         .expected("a number")
                         .advise("give a number such as 2, or run 'Quasi-static'"));
}

void check_time_step(const ParameterText &text, const Parameters &parameters)
{
  const auto *run = std::get_if<ImplicitParameters>(&parameters.solver);
  if (run && run->time_step > run->end_time)
    throw InputError(Complaint("'Implicit/Time step' is longer than the run")
                         .at(text.where("Implicit", "Time step"))
                         .found(fmt::format("{} s", run->time_step))
                         .expected(fmt::format("at most 'End time', {} s", run->end_time))
                         .advise("shorten it; what takes less than several steps is not resolved"));
}

/// What steps with implicit contact do not have.
void check_implicit_contact(const ParameterText &text, const Parameters &parameters)
{
  using Stepping = ExplicitParameters::ContactStepping;
  const auto *run = std::get_if<ExplicitParameters>(&parameters.solver);
  const bool is_implicit = std::holds_alternative<ImplicitParameters>(parameters.solver);
  if (!is_implicit && !(run && run->contact_stepping == Stepping::implicit_forces))
    return;
  const std::string name = is_implicit ? "'Implicit'" : "'Contact stepping = implicit'";
  const auto reject = [&](bool is_there, const std::string &what, const std::string &where)
  {
    if (is_there)
      throw InputError(
          Complaint(fmt::format("{} contradicts {}: they do not work together yet", what, name))
              .at(where)
              .found(name + " stands at " +
                     (is_implicit ? text.where("Implicit") : text.where("Explicit", "Contact stepping")))
              .advise(is_implicit ? "remove the one, or run 'Explicit'"
                                  : "remove the one, or set Contact stepping = explicit"));
  };
  reject(is_implicit && parameters.adaptivity, "'Adaptivity'", text.where("Adaptivity"));
  for (const BodyParameters &body : parameters.bodies)
    reject(is_implicit && body.material.viscosity > 0., "'Viscosity'",
           text.where(body_subsection(body.name) + "/Material", "Viscosity"));
  if (!parameters.contact)
    return;
  reject(is_implicit && parameters.contact->damping, "'Contact/Damping'", text.where("Contact/Damping"));
  reject(parameters.contact->potential == ContactParameters::Potential::volume, "'Potential = volume'",
         text.where("Contact", "Potential"));
}

/// What does not know bodies that yield.
void check_plastic(const ParameterText &text, const Parameters &parameters)
{
  const bool is_quasi_static = std::holds_alternative<QuasiStaticParameters>(parameters.solver);
  for (const BodyParameters &body : parameters.bodies)
  {
    const auto reject = [&](const std::string &path, const std::string &what, const std::string &next_step)
    {
      if (body.material.model == MaterialParameters::Model::plastic && text.find_subsection(path) != nullptr)
        throw InputError(Complaint(fmt::format("'Model = J2 plastic' contradicts '{}': {}", path, what))
                             .at(text.where(body_subsection(body.name) + "/Material", "Model"))
                             .found(fmt::format("'{}' stands at {}", path, text.where(path)))
                             .advise(next_step + ", or set Model = neo-Hookean"));
    };
    reject("Exact solution", "all of them are of elastic bodies", "remove the subsection");
    if (is_quasi_static && body.mesh.cell_type == MeshParameters::CellType::tetrahedra)
      reject("Adaptivity", "meshes of tetrahedra are made anew, without what their points remember",
             parameters.dimension == 2 ? "set Cell type = quadrilaterals" : "set Cell type = hexahedra");
  }
}

void check_contact_error(const ParameterText &text, const Parameters &parameters)
{
  if (parameters.contact && parameters.contact->correction && !parameters.contact->penalty_factor)
    throw InputError(Complaint("'Penalty factor = auto' and 'Contact/Correction' contradict each other: the "
                               "correction takes away the error that would choose the factor")
                         .at(text.where("Contact", "Penalty factor"))
                         .found("'Correction' stands at " + text.where("Contact/Correction"))
                         .advise("give a number such as 10, or remove the subsection"));
}

/// The volume potential knows only the corners of elements.
void check_degree_of_potential(const ParameterText &text, const Parameters &parameters)
{
  if (parameters.contact && parameters.contact->potential == ContactParameters::Potential::volume &&
      parameters.degree > 1)
    throw InputError(Complaint("the volume potential is one of elements of degree 1")
                         .at(text.where("Contact", "Potential"))
                         .found(fmt::format("Degree = {}", parameters.degree))
                         .expected("Degree = 1")
                         .advise("set Degree = 1, or Potential = surface"));
}

void check_adaptable(const ParameterText &text, const Parameters &parameters)
{
  if (!parameters.adaptivity)
    return;
  const bool is_explicit = std::holds_alternative<ExplicitParameters>(parameters.solver);
  if (std::none_of(parameters.bodies.begin(), parameters.bodies.end(),
                   [is_explicit](const BodyParameters &body)
                   { return is_adaptable(body.mesh, is_explicit); }))
    throw InputError(
        Complaint("'Adaptivity' finds no mesh that it could change")
            .at(text.where("Adaptivity"))
            .found(is_explicit ? "all bodies are of tetrahedra, whose meshes change only in quasi-static runs"
                               : "all meshes come from mesh files, beyond which their shapes are not known")
            .expected(is_explicit ? "a body of hexahedra" : "a generated mesh, or a shape from a file")
            .advise(is_explicit ? "remove 'Adaptivity', or run 'Quasi-static'"
                                : "remove 'Adaptivity', or take the shape as STEP or STL file"));
}

void check_densities(const ParameterText &text, const Parameters &parameters)
{
  const bool has_inertia = !std::holds_alternative<QuasiStaticParameters>(parameters.solver);
  const bool has_weight = parameters.gravity != Triple{};
  for (const BodyParameters &body : parameters.bodies)
    if ((has_inertia || has_weight) && body.material.density == 0.)
    {
      const std::string path = body_subsection(body.name) + "/Material";
      throw InputError(Complaint(fmt::format("'{}/Density' is missing", path))
                           .at(text.where(path))
                           .found(has_inertia ? "a run in motion needs the mass of every body"
                                              : "gravity needs the mass of every body")
                           .expected("a number > 0 [kg/m³]")
                           .advise("add 'set Density = …' there"));
    }
}

/// The listing of all parameters shows the names of bodies and obstacles as NAME.
void reject_template(const ParameterText &text)
{
  for (const std::string key : {"Bodies", "Obstacles"})
    for (const std::string &name : split(text.value("", key), ','))
      if (name == "NAME")
        throw InputError(
            Complaint("this is the template that 'signorini --parameters' prints: NAME stands for "
                      "a name of your own")
                .at(text.where("", key))
                .found(key + " = " + text.value("", key))
                .expected("names other than NAME")
                .advise("replace every NAME, fill in what is required, and remove the "
                        "subsections that the scene does not need"));
}

/// What can only be seen once all subsections have been read.
void check_together(const ParameterText &text, const Parameters &parameters)
{
  double end_time = 0.;
  std::visit([&end_time](const auto &run) { end_time = run.end_time; }, parameters.solver);
  if (std::holds_alternative<QuasiStaticParameters>(parameters.solver))
    check_quasi_static(text, parameters);
  else
    check_equilibrium_only(text, parameters);
  check_time_step(text, parameters);
  check_implicit_contact(text, parameters);
  check_plastic(text, parameters);
  check_contact_error(text, parameters);
  check_degree_of_potential(text, parameters);
  check_adaptable(text, parameters);
  check_densities(text, parameters);
  check_checkpoint(text, parameters);
  for (const BodyParameters &body : parameters.bodies)
    check_expressions(text, body, parameters.dimension, end_time);
  for (const ObstacleParameters &obstacle : parameters.obstacles)
    check_motion(text, obstacle, end_time);
  check_exact_solution(text, parameters);
}
} // namespace

Declarations declare_parameters(const ParameterText &text, const Extent extent)
{
  Declarations declarations;
  const DeclarationScope scope{text, extent, dimension_of(text)};
  declare_top_level(declarations, scope);
  for (const std::string &body : split(text.value("", "Bodies"), ','))
    declare_body(declarations, scope, body);
  for (const std::string &obstacle : split(text.value("", "Obstacles"), ','))
    declare_obstacle(declarations, scope, obstacle);
  if (scope.includes("Contact"))
    declare_contact(declarations, scope);
  declare_solver(declarations, scope);
  declare_adaptivity(declarations, scope);
  declare_exact_solution(declarations, scope);
  declare_study(declarations, scope);
  declare_output(declarations, scope);
  declare_checkpoint(declarations, scope);
  return declarations;
}

Parameters read_parameters(const ParameterText &text)
{
  reject_template(text);
  check_names_and_values(text, declare_parameters(text, Extent::everything));
  const Declarations in_use = declare_parameters(text, Extent::in_use);
  const unsigned int dimension = dimension_of(text);
  const SectionReader top(text, in_use, "", dimension);
  const std::vector<std::string> bodies = split(top.value("Bodies"), ',');
  const std::vector<std::string> obstacles = split(top.value("Obstacles"), ',');
  check_subsections(text, top, bodies, obstacles);
  check_presence(text, in_use);

  Parameters parameters;
  parameters.dimension = dimension;
  parameters.degree = top.integer("Degree");
  parameters.gravity = top.vector("Gravity");
  parameters.solver = read_solver(text, in_use);
  for (const std::string &body : bodies)
    for (BodyParameters &copy : read_body_and_copies(text, in_use, body, dimension))
      parameters.bodies.push_back(std::move(copy));
  for (const std::string &obstacle : obstacles)
    parameters.obstacles.push_back(read_obstacle(text, in_use, obstacle, dimension));
  if (text.find_subsection("Contact") != nullptr)
    parameters.contact = read_contact(text, in_use, names_of(parameters.bodies), obstacles);
  if (text.find_subsection("Adaptivity") != nullptr)
    parameters.adaptivity = read_adaptivity(text, in_use);
  if (text.find_subsection("Exact solution") != nullptr)
    parameters.exact_solution = read_exact_solution(text, in_use, parameters.dimension);
  if (text.find_subsection("Study") != nullptr)
    parameters.study = read_study(text, in_use, parameters);
  parameters.output = read_output(text, in_use);
  if (text.find_subsection("Checkpoint") != nullptr)
    parameters.checkpoint = read_checkpoint(text, in_use);
  check_together(text, parameters);
  check_output_directory(parameters.output.directory, text.where("Output", "Directory"));
  return parameters;
}
} // namespace signorini
