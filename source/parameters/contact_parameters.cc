// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/parameters/contact_parameters.h"

#include "signorini/parameters/section_reader.h"
#include "signorini/parameters/strings.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

namespace signorini
{
namespace
{
const NameTable<ObstacleParameters::Shape> &shapes()
{
  static const NameTable<ObstacleParameters::Shape> table{{"plane", ObstacleParameters::Shape::plane},
                                                          {"sphere", ObstacleParameters::Shape::sphere},
                                                          {"cylinder", ObstacleParameters::Shape::cylinder},
                                                          {"box", ObstacleParameters::Shape::box}};
  return table;
}

const NameTable<ContactParameters::Integration> &integrations()
{
  static const NameTable<ContactParameters::Integration> table{
      {"automatic", ContactParameters::Integration::automatic},
      {"face quadrature", ContactParameters::Integration::face_quadrature},
      {"face segments", ContactParameters::Integration::face_segments}};
  return table;
}

const NameTable<ContactParameters::Potential> &potentials()
{
  static const NameTable<ContactParameters::Potential> table{
      {"surface", ContactParameters::Potential::surface}, {"volume", ContactParameters::Potential::volume}};
  return table;
}

/// What the volume potential does not have.
void check_volume_potential(const ParameterText &text, const SectionReader &section,
                            const ContactParameters &contact, bool has_obstacles)
{
  const auto refuse = [&](const std::string &what)
  {
    throw InputError(section.complain("Potential", "the volume potential has no " + what)
                         .advise("remove that, or set Potential = surface"));
  };
  if (contact.damping)
    refuse("damping: its forces act on elements, not on pairs of points");
  if (contact.friction)
    refuse("friction: an overlap has no points that could stick");
  if (contact.correction)
    refuse("correction: it knows no pressures to start from");
  if (!contact.self_contact.empty())
    refuse("self-contact: the elements of a body overlap nowhere but at their faces");
  for (const char *key : {"Integration", "Quadrature points"})
    if (!has_obstacles && text.find("Contact", key) != nullptr)
      refuse(fmt::format("'{}': it integrates overlaps exactly", key));
  if (!contact.penalty_factor)
    refuse("choice of the penalty factor by errors: it knows no pressures to estimate them from");
}

/// What friction needs of the contact.
void check_friction(const ParameterText &text, const SectionReader &section, const ContactParameters &contact)
{
  if (contact.integration == ContactParameters::Integration::face_segments)
    throw InputError(
        section.complain("Integration", "friction needs points that stay, and those of face segments do not")
            .expected("automatic or face quadrature")
            .advise("set Integration = face quadrature, or remove 'Friction'"));
  if (contact.correction)
    throw InputError(
        Complaint("'Contact/Friction' contradicts 'Contact/Correction': they do not work together yet")
            .at(text.where("Contact/Correction"))
            .found("'Friction' stands at " + text.where("Contact/Friction"))
            .advise("remove the one, and raise Penalty factor for less penetration"));
  if (!contact.penalty_factor)
    throw InputError(section
                         .complain("Penalty factor",
                                   "the elastic slip of friction depends on the penalty factor, "
                                   "which can not change on the way")
                         .expected("a number with 'Friction'")
                         .advise("set a number, such as 10, or remove 'Friction'"));
}

bool is_in(const std::string &name, const std::vector<std::string> &names)
{
  return std::find(names.begin(), names.end(), name) != names.end();
}

std::vector<std::pair<std::string, std::string>> read_pairs(const SectionReader &section,
                                                            const std::vector<std::string> &bodies,
                                                            const std::vector<std::string> &obstacles)
{
  std::vector<std::string> all = bodies;
  all.insert(all.end(), obstacles.begin(), obstacles.end());
  std::vector<std::pair<std::string, std::string>> pairs;
  for (const std::string &pair : split(section.value("Excluded pairs"), ','))
  {
    const auto complain = [&](const std::string &what) { return section.complain("Excluded pairs", what); };
    const std::vector<std::string> names = split(pair, ':');
    if (names.size() != 2)
      throw InputError(complain(fmt::format("'{}' is not a pair", pair))
                           .expected("pairs of names as in a:b, c:d")
                           .advise("write the two names with a ':' between them"));
    for (const std::string &name : names)
      if (!is_in(name, all))
        throw InputError(complain(fmt::format("there is no body or obstacle '{}'", name))
                             .expected("two of " + join(all, ", "))
                             .did_you_mean(nearest_name(name, all))
                             .advise("correct the name or remove the pair"));
    if (std::any_of(pairs.begin(), pairs.end(),
                    [&names](const auto &other) {
                      return other == std::pair(names[0], names[1]) || other == std::pair(names[1], names[0]);
                    }))
      throw InputError(complain(fmt::format("'{}' stands in the list twice", pair))
                           .expected("every pair once, in one order of its names")
                           .advise("remove one of the two"));
    if (names[0] == names[1] || (is_in(names[0], obstacles) && is_in(names[1], obstacles)))
      throw InputError(complain(fmt::format("'{}' is never in contact", pair))
                           .expected("two different bodies, or a body and an obstacle")
                           .advise("remove the pair"));
    pairs.emplace_back(names[0], names[1]);
  }
  return pairs;
}

std::vector<std::string> read_self_contact(const SectionReader &section,
                                           const std::vector<std::string> &bodies)
{
  std::vector<std::string> names;
  for (const std::string &name : split(section.value("Self-contact"), ','))
  {
    const auto is_copy = [&name](const std::string &body) { return body.rfind(name + ".", 0) == 0; };
    if (std::none_of(bodies.begin(), bodies.end(), is_copy))
      names.push_back(name);
    else // all of them
      std::copy_if(bodies.begin(), bodies.end(), std::back_inserter(names), is_copy);
  }
  for (const std::string &name : names)
  {
    if (!is_in(name, bodies))
      throw InputError(section.complain("Self-contact", fmt::format("there is no body '{}'", name))
                           .expected("some of " + join(bodies, ", "))
                           .did_you_mean(nearest_name(name, bodies))
                           .advise("correct the name or remove it"));
    if (std::count(names.begin(), names.end(), name) > 1)
      throw InputError(section.complain("Self-contact", fmt::format("'{}' stands in the list twice", name))
                           .expected("some of " + join(bodies, ", ") + ", each once")
                           .advise("remove one of the two"));
  }
  return names;
}
} // namespace

void declare_obstacle(Declarations &declarations, const DeclarationScope &scope, const std::string &name)
{
  const std::string path = "Obstacle " + name;
  const auto shape_is = [&](const std::string &shape) { return scope.chosen(path, "Shape", shape, "plane"); };
  SubsectionDeclaration obstacle(declarations, path, "A rigid obstacle; its name stands in 'Obstacles'.");
  obstacle.add("Shape", one_of(names_in(shapes())), "plane", "",
               "Half-space behind a plane, sphere (2-D: disk), cylinder without ends (3-D), or box.");
  if (shape_is("plane") || shape_is("sphere") || shape_is("cylinder"))
    obstacle.add("Point", scope.vector(), scope.components("0, 0, 0"), "m",
                 "A point of the plane or of the cylinder's axis, or the centre of the sphere.");
  if (shape_is("plane"))
    obstacle.add("Normal", scope.vector(), scope.dimension == 3 ? "0, 0, 1" : "0, 1", "",
                 "Plane: points to where bodies may be, of any length but zero.");
  if (shape_is("cylinder"))
    obstacle.add("Axis", scope.vector(), scope.components("0, 0, 1"), "",
                 "Cylinder: direction of its axis, of any length but zero; not in 2-D.");
  if (shape_is("sphere") || shape_is("cylinder"))
    obstacle.add("Radius", positive_length(), "1", "m", "Sphere and cylinder: radius.");
  if (shape_is("box"))
  {
    obstacle.add("Lower corner", scope.vector(), scope.components("0, 0, 0"), "m",
                 "Box: smallest coordinates.");
    obstacle.add("Upper corner", scope.vector(), scope.components("1, 1, 1"), "m",
                 "Box: largest coordinates.");
  }
  obstacle.add(
      "Displacement", any_text(), "", "m",
      "How it moves as a whole, whatever touches it: a formula of t for each component, separated by "
      "';', 0 at t = 0; absent: fixed.");
}

namespace
{
/// A vector that is no direction if it is zero; `advice` says what to give instead.
Triple read_direction(const SectionReader &section, const std::string &key, const std::string &fault,
                      const std::string &advice)
{
  const Triple direction = section.vector(key);
  if (direction == Triple{})
    throw InputError(section.complain(key, fault).expected("a vector other than zero").advise(advice));
  return direction;
}

void read_corners(const SectionReader &section, const unsigned int dimension, ObstacleParameters &obstacle)
{
  obstacle.lower_corner = section.vector("Lower corner");
  obstacle.upper_corner = section.vector("Upper corner");
  for (unsigned int c = 0; c < dimension; ++c)
  {
    const double low = obstacle.lower_corner[c], high = obstacle.upper_corner[c];
    if (!(low < high))
      throw InputError(section
                           .complain(section.given("Upper corner") ? "Upper corner" : "Lower corner",
                                     fmt::format("component {} of 'Upper corner' of obstacle '{}' is not "
                                                 "above that of 'Lower corner'",
                                                 c + 1, obstacle.name))
                           .expected(fmt::format("upper > lower; here {} and {}", high, low))
                           .advise("exchange or correct the corners"));
    obstacle.point[c] = 0.5 * (low + high);
  }
}
} // namespace

ObstacleParameters read_obstacle(const ParameterText &text, const Declarations &in_use,
                                 const std::string &name, const unsigned int dimension)
{
  using Shape = ObstacleParameters::Shape;
  const SectionReader section(text, in_use, "Obstacle " + name, dimension);
  ObstacleParameters obstacle;
  obstacle.name = name;
  obstacle.shape = section.choice("Shape", shapes());
  if (section.given("Displacement"))
  {
    obstacle.displacement = section.formulas("Displacement");
    obstacle.place_of_displacement = section.place("Displacement");
  }
  if (obstacle.shape == Shape::box)
  {
    read_corners(section, dimension, obstacle);
    return obstacle;
  }
  obstacle.point = section.vector("Point");
  if (obstacle.shape == Shape::plane)
    obstacle.normal =
        read_direction(section, "Normal", fmt::format("the normal of obstacle '{}' has length zero", name),
                       "give the direction in which bodies may be, such as 0, 0, 1");
  else
    obstacle.radius = section.number("Radius");
  if (obstacle.shape != Shape::cylinder)
    return obstacle;
  if (dimension == 2)
    throw InputError(
        section.complain("Shape", "a cylinder needs three dimensions")
            .advise("use Shape = sphere, which is a disk in two dimensions, or set Dimension = 3"));
  obstacle.axis =
      read_direction(section, "Axis", fmt::format("the axis of obstacle '{}' has length zero", name),
                     "give its direction, such as 0, 1, 0");
  return obstacle;
}

void declare_contact(Declarations &declarations, const DeclarationScope &scope)
{
  SubsectionDeclaration contact(declarations, "Contact",
                                "Contact of bodies with each other and with obstacles.");
  contact.add(
      "Penalty factor", or_word(number_from_up_to(1e-6, 1e9), "auto"), "10", "",
      "α: stiffness of the contact relative to that of the cells behind it; auto (quasi-static runs): "
      "between 1 and 1e6, as large as the estimated errors ask for.");
  contact.add(
      "Potential", one_of(names_in(potentials())), "surface", "",
      "Contact of bodies: by the depth of points below the other surface, or by the overlap of elements "
      "of degree 1 (Munjiza's). Obstacles are always met by the surface.");
  contact.add(
      "Contact share", number_above_up_to(0., 1.), "0.25", "",
      "Penalty factor = auto: square of the estimated error by contact over that of discretization, which is "
      "about the ratio of their parts in the way of the loads; a quarter more is let pass.");
  contact.add("Integration", one_of(names_in(integrations())), "automatic", "",
              "Automatic: face segments in quasi-static runs without friction, else face quadrature.");
  contact.add(
      "Quadrature points", or_word(integer_from(1, 8), "automatic"), "automatic", "",
      "Quadrature points in each direction of a face. Automatic: 3; in quasi-static runs with friction "
      "on what has corners 8 in 2-D, 5 in 3-D, as a corner that digs in holds on to points far apart.");
  contact.add("Excluded pairs", any_text(), "", "",
              "Pairs of bodies, or of a body and an obstacle, that ignore each other: a:b, c:d.");
  contact.add("Self-contact", any_text(), "", "",
              "Bodies that may touch themselves, such as those that fold or have a slit: a, b. Not with the "
              "volume potential.");
  contact.add(
      "Maximum penetration", number_above(0.), "0.5", "",
      "In sizes of an element: a run in which bodies sink deeper into each other stops, as they could "
      "pass through; set far above 1, they may. Bodies that touch by the volume potential may sink in by a "
      "quarter of it.");
  contact.add(
      "Allow initial overlap", true_or_false(), "false", "",
      "Start although bodies overlap by more than a tenth of a cell; the energy of the overlap is reported.");
  if (scope.includes("Contact/Damping"))
    SubsectionDeclaration(declarations, "Contact/Damping", "Dissipation in contact; explicit runs only.")
        .add_required("Damping ratio", number_from(0.), "", "ξ: share of critical damping of the contact.");
  if (scope.includes("Contact/Friction"))
    SubsectionDeclaration(declarations, "Contact/Friction",
                          "Coulomb friction; not with the volume potential.")
        .add_required(
            "Friction coefficient", number_from_up_to(0., 10.), "",
            "μ: most of the tangential traction over the pressure. Rubber hardly reaches 4: a larger "
            "one than 10 would be a mistake; what never slides is one body.");
  if (scope.includes("Contact/Correction"))
  {
    SubsectionDeclaration correction(
        declarations, "Contact/Correction",
        "Takes away the error of the penalty at a fixed penalty factor: contact starts from the normal "
        "stress "
        "of the bodies, found again after each equilibrium; quasi-static runs only.");
    correction.add("Tolerance", number_between(0., 1.), "1e-4", "",
                   "Largest change of the pressures from step to step, relative to the largest pressure.");
    correction.add("Maximum steps", integer_from(1, 1000), "30", "", "Of correction in one load step.");
  }
}

ContactParameters read_contact(const ParameterText &text, const Declarations &in_use,
                               const std::vector<std::string> &bodies,
                               const std::vector<std::string> &obstacles)
{
  const SectionReader section(text, in_use, "Contact", 3);
  ContactParameters contact;
  contact.penalty_factor.reset();
  if (section.value("Penalty factor") != "auto")
    contact.penalty_factor = section.number("Penalty factor");
  contact.potential = section.choice("Potential", potentials());
  contact.contact_share = section.number("Contact share");
  contact.integration = section.choice("Integration", integrations());
  if (section.value("Quadrature points") != "automatic")
    contact.quadrature_points = section.integer("Quadrature points");
  contact.excluded_pairs = read_pairs(section, bodies, obstacles);
  contact.self_contact = read_self_contact(section, bodies);
  contact.max_penetration = section.number("Maximum penetration");
  contact.allow_initial_overlap = section.boolean("Allow initial overlap");
  if (text.find_subsection("Contact/Damping") != nullptr)
    contact.damping =
        DampingParameters{SectionReader(text, in_use, "Contact/Damping", 3).number("Damping ratio")};
  if (text.find_subsection("Contact/Friction") != nullptr)
    contact.friction =
        FrictionParameters{SectionReader(text, in_use, "Contact/Friction", 3).number("Friction coefficient")};
  if (text.find_subsection("Contact/Correction") != nullptr)
  {
    const SectionReader correction(text, in_use, "Contact/Correction", 3);
    contact.correction =
        CorrectionParameters{correction.number("Tolerance"), correction.integer("Maximum steps")};
  }
  if (contact.potential == ContactParameters::Potential::volume)
    check_volume_potential(text, section, contact, !obstacles.empty());
  if (contact.friction)
    check_friction(text, section, contact);
  return contact;
}

bool is_pair_excluded(const ContactParameters &contact, const std::string &one, const std::string &other)
{
  if (one == other)
    return !is_in(one, contact.self_contact);
  return std::any_of(contact.excluded_pairs.begin(), contact.excluded_pairs.end(),
                     [&](const auto &pair)
                     { return pair == std::pair(one, other) || pair == std::pair(other, one); });
}
} // namespace signorini
