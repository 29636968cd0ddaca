// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/body_parameters.h"

#include "signorini/mesh/read_mesh_file.h"
#include "signorini/parameters/mesh_parameters.h"
#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace signorini
{
namespace
{
const NameTable<MaterialParameters::Model> &models()
{
  static const NameTable<MaterialParameters::Model> table{
      {"linear elastic", MaterialParameters::Model::linear_elastic},
      {"neo-Hookean", MaterialParameters::Model::neo_hookean},
      {"J2 plastic", MaterialParameters::Model::plastic}};
  return table;
}

void declare_placement(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration placement(
      declarations, path,
      "Where the mesh is put: first scaled, then rotated, both about the origin, then "
      "shifted.");
  placement.add("Shift", scope.vector(), scope.components("0, 0, 0"), "m", "Displacement of the whole mesh.");
  placement.add("Rotation angle", any_number(), "0", "degrees", "Angle of rotation, counter-clockwise.");
  if (scope.dimension == 3)
    placement.add("Rotation axis", scope.vector(), "0, 0, 1", "",
                  "Direction of the axis of rotation, of any length but zero; not in 2-D.");
  placement.add("Scale", positive_length(), "1", "", "Factor of all lengths of the mesh.");
}

void declare_copies(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration copies(declarations, path,
                               "The body many times over, on a lattice that its own place is the first "
                               "corner of; the copies are named "
                               "NAME.1, NAME.2 and so on, the first component running first.");
  copies.add("Number", list_of(integer_from(1, 1000000), scope.dimension, scope.dimension),
             scope.components("1, 1, 1"), "", "In each direction.");
  copies.add_required("Spacing", scope.vector(), "m", "From one to the next, in each direction.");
}

void declare_material(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration material(declarations, path, "The material of the body; plane strain in 2-D.");
  material.add(
      "Model", one_of(names_in(models())), "linear elastic", "",
      "Small strain and small rotation; compressible finite strain; or finite strain of which a part "
      "stays, once von Mises' stress has reached a yield stress. A body that rotates needs one of the "
      "latter two. J2 plastic: not with 'Exact solution'.");
  material.add_required("Young's modulus", positive_number(), "Pa", "Stiffness in uniaxial tension.");
  material.add_required("Poisson's ratio", number_between(-1., 0.5), "", "Transverse contraction.");
  material.add("Density", positive_number(), "", "kg/m³",
               "Mass per undeformed volume; needed in motion ('Explicit', 'Implicit') and with gravity.");
  material.add(
      "Viscosity", positive_number(), "", "Pa s",
      "η: resistance 2η to the rate of the strain's deviator, beside the elastic stress (Kelvin-Voigt); "
      "absent: none; explicit runs only.");
  if (scope.chosen(path, "Model", "J2 plastic", "linear elastic"))
  {
    material.add_required("Yield stress", positive_number(), "Pa",
                          "J2 plastic: von Mises' stress at which it begins to yield, of Kirchhoff's stress: "
                          "true stress times the ratio of the volumes, that belongs to logarithmic strain.");
    material.add(
        "Hardening modulus", number_from_up_to(0., 1e30), "0", "Pa",
        "J2 plastic: by how much the yield stress grows with the equivalent plastic strain, which is "
        "logarithmic.");
  }
}

void declare_motion(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration motion(declarations, path,
                               "Rigid motion at time 0; in motion only ('Explicit', 'Implicit').");
  motion.add("Velocity", scope.vector(), scope.components("0, 0, 0"), "m/s",
             "Velocity of the centre of mass.");
  motion.add("Spin", scope.dimension == 3 ? scope.vector() : list_of(any_number(), 1, 1),
             scope.dimension == 3 ? "0, 0, 0" : "0", "rad/s",
             "Angular velocity about the centre of mass: a vector, in 2-D a number.");
}

void declare_support(Declarations &declarations, const DeclarationScope &scope, const std::string &path)
{
  SubsectionDeclaration support(
      declarations, path,
      "Prescribed displacement of the boundary of this name (box: left, right, front, back, "
      "bottom, top; ball: surface, and x, y, z for the cuts; cylinder: side, bottom, top; file: "
      "physical groups, surfaces, sets of faces and of nodes, and rest; STEP, BREP: surface_1, "
      "surface_2, …; STL: surface).");
  for (const std::string component : {"x", "y", "z"})
    if (component != "z" || scope.dimension == 3)
      support.add(component, any_text(), "", "m",
                  "Displacement along " + component + ", a formula of x, y, z, t; absent: free.");
}

void declare_load(Declarations &declarations, const std::string &path)
{
  SubsectionDeclaration load(declarations, path, "Traction on the boundary of this name.");
  load.add_required(
      "Traction", any_text(), "Pa",
      "Force per undeformed area: a formula of x, y, z, t for each component, separated by ';'.");
}

/// Supports or loads that are declared: those in the file and, as a pattern for all, NAME.
std::vector<std::string> boundary_subsections(const DeclarationScope &scope, const std::string &body,
                                              const std::string &prefix)
{
  std::vector<std::string> names = scope.text.names_below(body, prefix);
  const std::string pattern = prefix + "NAME";
  if (scope.extent == Extent::everything && std::find(names.begin(), names.end(), pattern) == names.end())
    names.push_back(pattern);
  return names;
}

PlacementParameters read_placement(const SectionReader &section, const unsigned int dimension)
{
  PlacementParameters placement;
  placement.shift = section.vector("Shift");
  placement.rotation_angle = section.number("Rotation angle");
  if (dimension == 3)
    placement.rotation_axis = section.vector("Rotation axis");
  if (placement.rotation_axis == Triple{})
    throw InputError(section.complain("Rotation axis", "the axis of rotation has length zero")
                         .expected("a vector other than zero")
                         .advise("give its direction, such as 0, 0, 1"));
  placement.scale = section.number("Scale");
  return placement;
}

MaterialParameters read_material(const SectionReader &section)
{
  MaterialParameters material;
  material.model = section.choice("Model", models());
  material.youngs_modulus = section.number("Young's modulus");
  material.poissons_ratio = section.number("Poisson's ratio");
  if (section.given("Density"))
    material.density = section.number("Density");
  if (section.given("Viscosity"))
    material.viscosity = section.number("Viscosity");
  if (material.model == MaterialParameters::Model::plastic)
  {
    material.yield_stress = section.number("Yield stress");
    material.hardening_modulus = section.number("Hardening modulus");
  }
  return material;
}

void read_motion(const SectionReader &section, const unsigned int dimension, BodyParameters &body)
{
  body.initial_velocity = section.vector("Velocity");
  if (dimension == 3)
    body.initial_spin = section.vector("Spin");
  else
    body.initial_spin[2] = section.number("Spin");
  if (body.initial_spin != Triple{} && body.material.model == MaterialParameters::Model::linear_elastic)
    throw InputError(
        section
            .complain("Spin", fmt::format("body '{}' spins, but its material is linear elastic: small strain "
                                          "takes a rotation for a deformation",
                                          body.name))
            .expected("no spin with Model = linear elastic")
            .advise("set Model = neo-Hookean in its Material"));
}

/// The boundary of `Support NAME` or `Load NAME`; throws if the mesh has none of that name.
std::string read_boundary(const SectionReader &section, const std::string &prefix, const BodyParameters &body,
                          const unsigned int dimension)
{
  const std::string boundary = ParameterSubsection{section.path(), "", 0}.name().substr(prefix.size());
  const std::vector<std::string> names = boundary_names(body.mesh, dimension);
  if (std::find(names.begin(), names.end(), boundary) != names.end())
    return boundary;
  const std::size_t n_nodes =
      body.mesh.mesh_of_file ? count_nodes_in_set(body.mesh.file, dimension, boundary) : 0;
  const std::string reason =
      n_nodes > 0 ? fmt::format(": the set of {} nodes of this name makes none", n_nodes) : "";
  throw InputError(
      section
          .complain(fmt::format("the mesh of body '{}' has no boundary '{}'{}", body.name, boundary, reason))
          .found(section.path())
          .expected("one of " + join(names, ", "))
          .did_you_mean(n_nodes > 0 ? "" : nearest_name(boundary, names))
          .advise(n_nodes > 0
                      ? "give the set all corners of its faces: it is a boundary if it holds whole outer "
                        "faces, but not all nodes, and none of another boundary"
                      : "use a boundary of this shape"));
}

SupportParameters read_support(const SectionReader &section, const std::string &boundary,
                               const unsigned int dimension)
{
  SupportParameters support;
  support.boundary = boundary;
  for (unsigned int c = 0; c < dimension; ++c)
    if (const std::string key(1, "xyz"[c]); section.given(key))
    {
      support.displacement[c] = section.value(key);
      support.places[c] = section.place(key);
    }
  if (std::none_of(support.displacement.begin(), support.displacement.end(),
                   [](const auto &component) { return component.has_value(); }))
    throw InputError(section.complain("a support holds no component")
                         .found(section.path())
                         .advise("set x, y or z, for example 'set x = 0', or remove the support"));
  return support;
}

LoadParameters read_load(const SectionReader &section, const std::string &boundary)
{
  LoadParameters load{boundary, {{"0", "0", "0"}}, section.place("Traction")};
  const std::vector<std::string> parts = section.formulas("Traction");
  std::copy(parts.begin(), parts.end(), load.traction.begin());
  return load;
}

/// Throws for a load along a component that a support of the same boundary prescribes: it would do nothing.
void check_loads(const BodyParameters &body, const unsigned int dimension)
{
  for (const LoadParameters &load : body.loads)
    for (const SupportParameters &support : body.supports)
      for (unsigned int c = 0; c < dimension; ++c)
        if (load.boundary == support.boundary && support.displacement[c] &&
            parse_number(load.traction[c]).value_or(1.) != 0.)
          throw InputError(
              Complaint(fmt::format("the load and the support of boundary '{}' of body '{}' "
                                    "contradict each other in component {}",
                                    load.boundary, body.name, "xyz"[c]))
                  .at(load.place)
                  .found(fmt::format("traction {}, but the support at {} prescribes {} = {}",
                                     load.traction[c], support.places[c], "xyz"[c], *support.displacement[c]))
                  .expected("0 for a component that is supported")
                  .advise("set the component of the traction to 0, or leave it out of the support"));
}

/// Throws for a body so far from the origin, or so thin, that its coordinates have no digits left for its
/// shape.
void check_digits(const SectionReader &mesh, const BodyParameters &body, const unsigned int dimension)
{
  constexpr double largest_ratio = 1e9;
  Triple low{}, high{};
  low.fill(std::numeric_limits<double>::max());
  high.fill(-std::numeric_limits<double>::max());
  for (const std::string &boundary : boundary_names(body.mesh, dimension))
    for (const Triple &point : boundary_points(body.mesh, dimension, boundary))
      for (unsigned int c = 0; c < dimension; ++c)
      {
        low[c] = std::min(low[c], point[c]);
        high[c] = std::max(high[c], point[c]);
      }
  double smallest = std::numeric_limits<double>::max(), farthest = 0.;
  for (unsigned int c = 0; c < dimension; ++c)
  {
    const double scale = body.placement.scale;
    smallest = std::min(smallest, scale * (high[c] - low[c]));
    farthest = std::max(farthest, scale * std::max(-low[c], high[c]) + std::abs(body.placement.shift[c]));
  }
  if (!(smallest * largest_ratio >= farthest) || !positive_length().contains(fmt::format("{}", smallest)))
    throw InputError(mesh.complain(fmt::format("body '{}' is too small to be told from a point", body.name))
                         .found(fmt::format("{} m thick, at coordinates up to {} m", smallest, farthest))
                         .expected(fmt::format("{} m, and more than {:.0e} of its largest coordinate",
                                               positive_length().description(), 1. / largest_ratio))
                         .advise("enlarge it, or put it nearer to the origin"));
}
} // namespace

void declare_body(Declarations &declarations, const DeclarationScope &scope, const std::string &name)
{
  const std::string path = "Body " + name;
  SubsectionDeclaration(declarations, path, "A deformable body; its name stands in 'Bodies'.");
  declare_mesh(declarations, scope, path + "/Mesh");
  if (scope.includes(path + "/Placement"))
    declare_placement(declarations, scope, path + "/Placement");
  if (scope.includes(path + "/Copies"))
    declare_copies(declarations, scope, path + "/Copies");
  declare_material(declarations, scope, path + "/Material");
  if (scope.includes(path + "/Initial motion"))
    declare_motion(declarations, scope, path + "/Initial motion");
  for (const std::string &support : boundary_subsections(scope, path, "Support "))
    declare_support(declarations, scope, join_path(path, support));
  for (const std::string &load : boundary_subsections(scope, path, "Load "))
    declare_load(declarations, join_path(path, load));
}

BodyParameters read_body(const ParameterText &text, const Declarations &in_use, const std::string &name,
                         const unsigned int dimension)
{
  const std::string path = "Body " + name;
  const auto section = [&](const std::string &subsection)
  { return SectionReader(text, in_use, join_path(path, subsection), dimension); };
  BodyParameters body;
  body.name = name;
  body.mesh = read_mesh(text, in_use, path + "/Mesh", dimension);
  if (text.find_subsection(path + "/Placement") != nullptr)
    body.placement = read_placement(section("Placement"), dimension);
  check_digits(section("Mesh"), body, dimension);
  body.material = read_material(section("Material"));
  if (text.find_subsection(path + "/Initial motion") != nullptr)
    read_motion(section("Initial motion"), dimension, body);
  const auto read_each = [&](const std::string &prefix, const auto &read_entry, auto &entries)
  {
    for (const std::string &entry : text.names_below(path, prefix))
      entries.push_back(read_entry(section(entry), read_boundary(section(entry), prefix, body, dimension)));
  };
  const auto read_one_support = [&](const SectionReader &section_of, const std::string &boundary)
  { return read_support(section_of, boundary, dimension); };
  read_each("Support ", read_one_support, body.supports);
  read_each("Load ", read_load, body.loads);
  check_loads(body, dimension);
  return body;
}

std::vector<BodyParameters> read_body_and_copies(const ParameterText &text, const Declarations &in_use,
                                                 const std::string &name, const unsigned int dimension)
{
  const BodyParameters body = read_body(text, in_use, name, dimension);
  const std::string path = "Body " + name + "/Copies";
  if (text.find_subsection(path) == nullptr)
    return {body};
  const SectionReader section(text, in_use, path, dimension);
  const std::array<unsigned int, 3> number = section.integers("Number");
  const Triple spacing = section.vector("Spacing");
  constexpr double most = 1e6;
  if (const double n_copies = 1. * number[0] * number[1] * number[2]; n_copies > most)
    throw InputError(section.complain("Number", fmt::format("body '{}' has {:.3g} copies", name, n_copies))
                         .expected(fmt::format("at most {:.0e} in all", most))
                         .advise("lower the numbers"));
  std::vector<BodyParameters> copies;
  for (unsigned int k = 0; k < number[2]; ++k)
    for (unsigned int j = 0; j < number[1]; ++j)
      for (unsigned int i = 0; i < number[0]; ++i)
      {
        copies.push_back(body);
        copies.back().name = fmt::format("{}.{}", name, copies.size());
        const std::array<unsigned int, 3> place{{i, j, k}};
        for (unsigned int c = 0; c < dimension; ++c)
          copies.back().placement.shift[c] += place[c] * spacing[c];
      }
  check_digits(SectionReader(text, in_use, "Body " + name + "/Mesh", dimension), copies.back(), dimension);
  return copies;
}

std::string body_subsection(const std::string &name)
{
  return "Body " + name.substr(0, name.find('.'));
}
} // namespace signorini
