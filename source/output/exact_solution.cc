// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/exact_solution.h"

#include "signorini/base/exceptions.h"
#include "signorini/output/error_rows.h"
#include "signorini/output/friction_loop.h"
#include "signorini/output/impact_solutions.h"
#include "signorini/output/rough_plane.h"
#include "signorini/parameters/exact_solution_parameters.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace signorini
{
namespace
{
const double pi = std::acos(-1.);

bool is_hertz_cylinder(const Parameters &parameters)
{
  return parameters.exact_solution->name == "Hertz cylinder";
}

/// Hertz's answers for the force that was measured.
struct Hertz
{
  double radius = 0.;        ///< a
  double peak_pressure = 0.; ///< p₀
  double approach = 0.;      ///< δ; spheres only
};

template <int dim>
Hertz solve_hertz(const Results<dim> &results)
{
  const auto &values = results.parameters->exact_solution->values;
  const double R = values.at("Radius"), fraction = values.at("Fraction of the contact");
  const double P = results.contact.resultants.at(0).norm() / fraction;
  const double E = contact_modulus(*results.parameters);
  if (is_hertz_cylinder(*results.parameters))
  {
    const double a = std::sqrt(4. * P * R / (pi * E));
    return {a, 2. * P / (pi * a), 0.};
  }
  const double a = std::cbrt(0.75 * P * R / E);
  return {a, 1.5 * P / (pi * a * a), a * a / R};
}

/// Relative L2 distance of the sampled pressure from the exact one, over the sampled area.
template <int dim>
double profile_error(const Results<dim> &results)
{
  double difference = 0., norm_squared = 0.;
  for (const auto &sample : results.samples)
  {
    const double exact = exact_pressure(results, sample.position.template head<dim - 1>().norm());
    difference += sample.area * std::pow(sample.pressure - exact, 2);
    norm_squared += sample.area * exact * exact;
  }
  return std::sqrt(difference / norm_squared);
}

/// Contact radius from the second moment of the sampled pressure about the axis, ⟨r²⟩ = ∫ p r² dA / ∫ p dA:
/// of Hertz's pressures it is 2a²/5 of a ball, a²/4 of a cylinder. It hardly feels which points at the rim
/// touch.
template <int dim>
double radius_of_pressure(const Results<dim> &results)
{
  double force = 0., moment = 0.;
  for (const auto &sample : results.samples)
  {
    force += sample.area * sample.pressure;
    moment += sample.area * sample.pressure * sample.position.template head<dim - 1>().squaredNorm();
  }
  return std::sqrt((is_hertz_cylinder(*results.parameters) ? 4. : 2.5) * moment / force);
}

template <int dim>
std::vector<ErrorRow> hertz(const Results<dim> &results)
{
  const Hertz exact = solve_hertz(results);
  const double fraction = results.parameters->exact_solution->values.at("Fraction of the contact");
  const double area = results.contact.area / fraction;
  const bool is_cylinder = is_hertz_cylinder(*results.parameters);
  std::vector<ErrorRow> rows{
      compare("peak pressure", results.max_projected_pressure, exact.peak_pressure),
      compare("contact radius", radius_of_pressure(results), exact.radius),
      compare("contact area", area, is_cylinder ? 2. * exact.radius : pi * exact.radius * exact.radius)};
  if (!is_cylinder)
    rows.push_back(compare("approach", results.largest_support_displacement, exact.approach));
  rows.push_back(
      {"pressure profile (relative L2 distance)", profile_error(results), 0., profile_error(results)});
  return rows;
}

template <int dim>
std::vector<ErrorRow> squeezed_bars(const Results<dim> &results)
{
  const BodyParameters &one = results.parameters->bodies.at(0), &other = results.parameters->bodies.at(1);
  // The stress comes from the displacements, not from the penetration that is to be judged.
  const double pressure = -results.smallest_stress(dim - 1, dim - 1);
  double layers = 0., thickness = 0.;
  for (unsigned int body = 0; body < 2; ++body)
    for (unsigned int i = 0; i < results.samples.size(); ++i)
      if (results.sample_bodies[i] == body && results.samples[i].pressure > 0.)
      {
        thickness = results.sample_thicknesses[i];
        layers += pressure * thickness / results.parameters->bodies[body].material.youngs_modulus;
        break;
      }
  const auto shortening = [&](const BodyParameters &body)
  {
    return pressure / body.material.youngs_modulus *
           (body.mesh.upper_corner[dim - 1] - body.mesh.lower_corner[dim - 1]);
  };
  const double end = results.body_end_displacement.at(1)[dim - 1];
  const double share = results.contact.max_penetration / layers;
  const std::string share_name = "penetration over shortening of the surface layers";
  // The penetration lengthens the way of the load: the square of the error in the energy norm is the work
  // that it does there.
  const double load = norm(results.total_load), shortenings = shortening(one) + shortening(other);
  std::vector<ErrorRow> rows{
      compare("contact resultant against the load", results.contact.resultants.at(0).norm(), load),
      compare("displacement of the loaded end", end, shortenings)};
  if (results.correction_change)
  {
    rows.push_back({share_name, share, 0., share});
    return rows;
  }
  rows.push_back(compare(share_name, share, 1. / results.penalty_factor));
  rows.push_back(compare("estimated contact error", std::sqrt(results.estimate.contact),
                         std::sqrt(load * (end - shortenings))));
  return rows;
}

template <int dim>
std::vector<ErrorRow> patch(const Results<dim> &results)
{
  const double exact = results.parameters->exact_solution->values.at("Pressure");
  // Segments cut off by round-off stand for no area and say nothing.
  double worst = exact, largest_area = 0.;
  for (const auto &sample : results.samples)
    largest_area = std::max(largest_area, sample.area);
  for (const auto &sample : results.samples)
    if (sample.area > 1e-9 * largest_area && std::abs(sample.pressure - exact) >= std::abs(worst - exact))
      worst = sample.pressure;
  const double low = -results.smallest_stress(dim - 1, dim - 1),
               high = -results.largest_stress(dim - 1, dim - 1);
  double worst_node = exact;
  for (const double pressure : results.nodal_pressures)
    if (std::abs(pressure - exact) >= std::abs(worst_node - exact))
      worst_node = pressure;
  const double load = norm(results.total_load);
  std::vector<ErrorRow> rows;
  if (results.parameters->contact->potential == ContactParameters::Potential::surface)
    rows = {compare("contact pressure (worst point)", worst, exact),
            compare("projected contact pressure (worst node)", worst_node, exact)};
  rows.push_back(compare("normal stress (largest)", low, exact));
  rows.push_back(compare("normal stress (smallest)", high, exact));
  rows.push_back(compare("resultant", results.contact.resultants.at(0).norm(), load));
  double other = 0.;
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      if ((i != dim - 1 || j != dim - 1) && !(dim == 2 && i == 2 && j == 2))
        other = std::max(
            {other, std::abs(results.smallest_stress(i, j)), std::abs(results.largest_stress(i, j))});
  rows.push_back({"other stresses over the pressure", other / exact, 0., other / exact});
  return rows;
}

/// Two bodies that slide on each other without friction under a constant force, from the rows after the
/// first.
template <int dim>
std::vector<ErrorRow> sliding_contact(const Results<dim> &results)
{
  double sum = 0., least = std::numeric_limits<double>::max(), most = 0., tangential = 0.;
  for (std::size_t i = 1; i < results.history.size(); ++i)
  {
    const auto &force = results.history[i].bodies.at(1).contact_force;
    const double normal = force[dim - 1];
    sum += normal;
    least = std::min(least, normal);
    most = std::max(most, normal);
    for (unsigned int d = 0; d + 1 < dim; ++d)
      tangential = std::max(tangential, std::abs(force[d]));
  }
  const double mean = sum / static_cast<double>(results.history.size() - 1),
               ripple = 0.5 * (most - least) / mean, drag = tangential / mean;
  return {compare("mean normal force", mean, results.parameters->exact_solution->values.at("Normal force")),
          {"ripple of the normal force", ripple, 0., ripple},
          {"largest tangential force over the normal one", drag, 0., drag}};
}

/// When there must be contact for a comparison.
enum class Touching
{
  at_the_end,
  once,
  never ///< need not be
};

template <int dim>
std::vector<ErrorRow> displacement(const Results<dim> &results)
{
  const DisplacementError &error = results.displacement_error;
  const double relative = error.displacement / error.displacement_norm,
               relative_energy = error.energy / error.energy_norm;
  return {
      {"displacement (relative L2 distance)", relative, 0., relative},
      {"strain (relative distance in the energy norm)", relative_energy, 0., relative_energy},
      compare("estimated discretization error", std::sqrt(results.estimate.discretization), error.energy)};
}

template <int dim>
struct Case
{
  std::string name;
  Touching touching;
  std::function<std::vector<ErrorRow>(const Results<dim> &)> compute;
};

template <int dim>
const std::vector<Case<dim>> &cases()
{
  static const std::vector<Case<dim>> table{
      {"Hertz sphere", Touching::at_the_end, hertz<dim>},
      {"Hertz cylinder", Touching::at_the_end, hertz<dim>},
      {"Squeezed bars", Touching::at_the_end, squeezed_bars<dim>},
      {"Patch", Touching::at_the_end, patch<dim>},
      {"Sliding contact", Touching::at_the_end, sliding_contact<dim>},
      {"Bar impact", Touching::once, compare_with_bar_impact<dim>},
      {"Ball impact", Touching::once, compare_with_ball_impact<dim>},
      {"Bounce", Touching::once, compare_with_bounce<dim>},
      {"Rough plane", Touching::once, compare_with_rough_plane<dim>},
      {"Friction loop", Touching::at_the_end, compare_with_friction_loop<dim>},
      {"Displacement", Touching::never, displacement<dim>}};
  return table;
}

template <int dim>
void check_touching(const Results<dim> &results, const Case<dim> &exact)
{
  const bool is_at_end = exact.touching == Touching::at_the_end;
  if (exact.touching == Touching::never || (is_at_end ? results.contact.n_active > 0 : results.max_area > 0.))
    return;
  throw NumericalError(Complaint("nothing touches " +
                                 std::string(is_at_end ? "at the end" : "in the whole run") +
                                 ": nothing to compare with case '" + exact.name + "'")
                           .at("Exact solution")
                           .advise("look at the last fields; let loads or supports close the gap, or remove "
                                   "'Exact solution'"));
}

/// A study must know before its first run what it will compare.
[[maybe_unused]] bool are_known(const std::vector<ErrorRow> &rows, const std::string &name)
{
  const std::vector<std::string> known = exact_solution_quantities(name);
  return std::all_of(rows.begin(), rows.end(),
                     [&](const ErrorRow &row)
                     { return std::find(known.begin(), known.end(), row.quantity) != known.end(); });
}

void check_finite(const std::vector<ErrorRow> &rows, const std::string &name)
{
  for (const ErrorRow &row : rows)
    if (!std::isfinite(row.computed) || !std::isfinite(row.exact) || !std::isfinite(row.relative_error))
      throw NumericalError(
          Complaint("'" + row.quantity + "' cannot be compared with case '" + name + "': it is not a number")
              .at("Exact solution")
              .advise("look at the last fields; let loads or supports press the bodies together, or remove "
                      "'Exact solution'"));
}
} // namespace

template <int dim>
std::vector<ErrorRow> compute_errors(const Results<dim> &results)
{
  for (const Case<dim> &exact : cases<dim>())
    if (results.parameters->exact_solution && exact.name == results.parameters->exact_solution->name)
    {
      check_touching(results, exact);
      const std::vector<ErrorRow> rows = exact.compute(results);
      Assert(are_known(rows, exact.name), dealii::ExcInternalError());
      check_finite(rows, exact.name);
      return rows;
    }
  return {};
}

bool has_exact_profile(const Parameters &parameters)
{
  return parameters.exact_solution && parameters.exact_solution->name.rfind("Hertz", 0) == 0;
}

template <int dim>
double exact_pressure(const Results<dim> &results, double radius)
{
  const Hertz exact = solve_hertz(results);
  return radius < exact.radius ? exact.peak_pressure * std::sqrt(1. - std::pow(radius / exact.radius, 2))
                               : 0.;
}

template std::vector<ErrorRow> compute_errors<2>(const Results<2> &);
template std::vector<ErrorRow> compute_errors<3>(const Results<3> &);
template double exact_pressure<2>(const Results<2> &, double);
template double exact_pressure<3>(const Results<3> &, double);
} // namespace signorini
