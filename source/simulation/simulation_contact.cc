// SPDX-License-Identifier: LGPL-2.1-or-later
// What a Simulation builds and watches of contact.
#include "signorini/simulation/simulation.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_parameters.h"
#include "signorini/parameters/contact_parameters.h"
#include "signorini/simulation/initial_overlap.h"

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace signorini
{
namespace
{
/// A direction of a face. A corner that digs into an element holds on to a point there with the force of all
/// that the point stands for: under friction points must be dense. In motion points cost too much of a step
/// for that to be the default.
template <int dim>
unsigned int choose_quadrature_points(const Parameters &parameters)
{
  const ContactParameters &contact = *parameters.contact;
  const bool has_corners =
      parameters.bodies.size() > 1 || !contact.self_contact.empty() ||
      std::any_of(parameters.obstacles.begin(), parameters.obstacles.end(),
                  [](const auto &obstacle) { return obstacle.shape == ObstacleParameters::Shape::box; });
  const bool is_at_rest = std::holds_alternative<QuasiStaticParameters>(parameters.solver);
  const unsigned int automatic = !(is_at_rest && contact.friction && has_corners) ? 3 : dim == 2 ? 8 : 5;
  return contact.quadrature_points.value_or(automatic);
}

template <int dim>
contact::PotentialSettings make_settings(const Parameters &parameters, double penalty_factor)
{
  using Wanted = ContactParameters::Integration;
  const ContactParameters &contact = *parameters.contact;
  const bool is_in_motion = !std::holds_alternative<QuasiStaticParameters>(parameters.solver);
  contact::PotentialSettings settings;
  settings.penalty_factor = penalty_factor;
  settings.n_quadrature_points = choose_quadrature_points<dim>(parameters);
  const bool is_by_faces = contact.integration == Wanted::automatic
                               ? is_in_motion || contact.friction.has_value()
                               : contact.integration == Wanted::face_quadrature;
  settings.integration =
      is_by_faces ? contact::Integration::face_quadrature : contact::Integration::face_segments;
  if (contact.damping)
    settings.damping_ratio = contact.damping->damping_ratio;

  const auto find = [](const auto &list, const std::string &name)
  {
    return static_cast<unsigned int>(
        std::find_if(list.begin(), list.end(), [&](const auto &entry) { return entry.name == name; }) -
        list.begin());
  };
  for (const std::string &name : contact.self_contact)
    settings.self_contact.push_back(find(parameters.bodies, name));
  const unsigned int n_bodies = parameters.bodies.size();
  for (const auto &[one, other] : contact.excluded_pairs)
  {
    const unsigned int first = find(parameters.bodies, one), second = find(parameters.bodies, other);
    if (first < n_bodies && second < n_bodies)
      settings.excluded_body_pairs.emplace_back(first, second);
    else if (first < n_bodies)
      settings.excluded_obstacle_pairs.emplace_back(first, find(parameters.obstacles, other));
    else
      settings.excluded_obstacle_pairs.emplace_back(second, find(parameters.obstacles, one));
  }
  return settings;
}

template <int dim>
std::string format_point(const SpatialVector<dim> &x)
{
  const SpatialVector<dim> without_minus_zeros = x.array() + 0.;
  return fmt::format("({:.6g})", fmt::join(without_minus_zeros, ", "));
}
} // namespace

template <int dim>
void Simulation<dim>::build_contact()
{
  constexpr double first_penalty_factor = 10.;
  if (results.penalty_factor == 0.)
    results.penalty_factor = parameters.contact->penalty_factor.value_or(first_penalty_factor);
  const contact::PotentialSettings settings = make_settings<dim>(parameters, results.penalty_factor);
  surface_map = std::make_unique<SurfaceMap<dim>>(scene, *discretization);
  results.has_contact = true;
  if (scene.n_bodies() > 1 && parameters.contact->potential == ContactParameters::Potential::volume)
  {
    contact::VolumePotentialSettings volume_settings;
    volume_settings.penalty_factor = results.penalty_factor;
    volume_settings.excluded_body_pairs = settings.excluded_body_pairs;
    volume_map = std::make_unique<VolumeMap<dim>>(scene, *discretization);
    forces.volume_contacts.push_back(std::make_shared<VolumeContactForce<dim>>(
        "contact of bodies", *volume_map, volume_settings, communicator));
  }
  else if (scene.n_bodies() > 1 || !settings.self_contact.empty())
    forces.surface_contacts.push_back(std::make_shared<ContactForce<dim>>(
        "contact of bodies", false, *surface_map, typename contact::ContactPotential<dim>::Obstacles(),
        settings, communicator));
  if (!scene.obstacles.empty())
  {
    contact::PotentialSettings obstacles_only = settings;
    obstacles_only.meets_bodies = false;
    forces.surface_contacts.push_back(std::make_shared<ContactForce<dim>>(
        "contact with obstacles", true, *surface_map, scene.obstacles, obstacles_only, communicator));
    if (scene.is_any_obstacle_moving())
    {
      forces.surface_contacts.back()->set_motions(scene.obstacle_motions);
      forces.moving_contacts.push_back(forces.surface_contacts.back());
    }
  }
  forces.contacts.assign(forces.volume_contacts.begin(), forces.volume_contacts.end());
  forces.contacts.insert(forces.contacts.end(), forces.surface_contacts.begin(),
                         forces.surface_contacts.end());
  if (settings.damping_ratio)
    forces.damped_contacts = forces.surface_contacts;
  if (!parameters.contact->friction)
    return;
  const auto *explicit_parameters = std::get_if<ExplicitParameters>(&parameters.solver);
  const bool is_explicit =
      explicit_parameters != nullptr &&
      explicit_parameters->contact_stepping == ExplicitParameters::ContactStepping::explicit_forces;
  for (const auto &contact : forces.surface_contacts)
    forces.frictions.push_back(std::make_shared<FrictionForce<dim>>(
        *contact, parameters.contact->friction->coefficient,
        is_explicit ? contact::SlidUnder::mean_traction : contact::SlidUnder::last_traction, communicator));
}

template <int dim>
std::vector<std::vector<contact::PlacedSlip<dim>>> Simulation<dim>::place_slips() const
{
  std::vector<std::vector<contact::PlacedSlip<dim>>> slips;
  for (const auto &friction : forces.frictions)
    slips.push_back(friction->placed_slips());
  return slips;
}

template <int dim>
void Simulation<dim>::remember_slips(std::vector<std::vector<contact::PlacedSlip<dim>>> slips)
{
  for (std::size_t i = 0; i < slips.size(); ++i)
    forces.frictions[i]->remember(std::move(slips[i]));
}

template <int dim>
auto Simulation<dim>::measure_terms() const -> MeasuresOfTerms
{
  MeasuresOfTerms measures;
  for (const auto &contact : forces.contacts)
    measures.push_back(contact->measure());
  return measures;
}

template <int dim>
contact::ContactMeasures<dim> Simulation<dim>::merge(const MeasuresOfTerms &measures)
{
  if (measures.empty())
    return {};
  contact::ContactMeasures<dim> total = measures.front();
  for (std::size_t i = 1; i < measures.size(); ++i)
  {
    const contact::ContactMeasures<dim> &other = measures[i];
    if (other.max_penetration_over_thickness > total.max_penetration_over_thickness)
    {
      total.max_penetration_over_thickness = other.max_penetration_over_thickness;
      total.deepest_body = other.deepest_body;
      total.deepest_thickness = other.deepest_thickness;
      total.deepest_position = other.deepest_position;
    }
    total.max_penetration = std::max(total.max_penetration, other.max_penetration);
    total.max_pressure = std::max(total.max_pressure, other.max_pressure);
    total.max_stiffness = std::max(total.max_stiffness, other.max_stiffness);
    total.area += other.area;
    total.n_pairs += other.n_pairs;
    total.n_active += other.n_active;
    for (unsigned int body = 0; body < total.resultants.size(); ++body)
      total.resultants[body] += other.resultants[body];
  }
  return total;
}

template <int dim>
void Simulation<dim>::record_contact(const MeasuresOfTerms &measures)
{
  results.contact = merge(measures);
  const contact::ContactMeasures<dim> &now = results.contact;
  results.max_penetration = std::max(results.max_penetration, now.max_penetration);
  results.max_penetration_over_thickness =
      std::max(results.max_penetration_over_thickness, now.max_penetration_over_thickness);
  results.max_pressure = std::max(results.max_pressure, now.max_pressure);
  results.max_area = std::max(results.max_area, now.area);
  results.max_n_pairs = std::max(results.max_n_pairs, now.n_pairs);
  results.max_stiffness = std::max(results.max_stiffness, now.max_stiffness);
}

template <int dim>
void Simulation<dim>::check_obstacle_sizes() const
{
  // Between the points of a face a small ball is not seen before it has gone this deep into a flat face.
  const auto unseen_depth = [this](double radius, const Facet<dim> &facet)
  {
    const auto &x = surface_map->surface().reference_positions;
    const double edge = (x[facet.nodes[facet.degree]] - x[facet.nodes[0]]).norm();
    const double reach = 0.6 * std::sqrt(dim - 1.) * edge / choose_quadrature_points<dim>(parameters);
    return reach < radius ? radius - std::sqrt(radius * radius - reach * reach)
                          : std::numeric_limits<double>::max();
  };
  for (const auto &obstacle : scene.obstacles)
  {
    if (std::isinf(obstacle->room()))
      continue;
    std::vector<int> is_seen(scene.n_bodies(), 0);
    for (const Facet<dim> &facet : surface_map->surface().facets)
      if (unseen_depth(obstacle->room(), facet) < 0.25 * facet.room)
        is_seen[facet.body] = 1;
    dealii::Utilities::MPI::max(is_seen, communicator, is_seen);
    for (unsigned int body = 0; body < scene.n_bodies(); ++body)
      if (is_seen[body] == 0 &&
          !is_pair_excluded(*parameters.contact, scene.body_names[body], obstacle->name()))
        throw InputError(
            Complaint(
                fmt::format("obstacle '{}' is too small for the faces of body '{}': it could slip between "
                            "their points of integration",
                            obstacle->name(), scene.body_names[body]))
                .at(text->where("Obstacle " + obstacle->name()))
                .found(fmt::format("a radius, or half of the smallest width, of {} m", obstacle->room()))
                .expected("to be seen before it is a quarter of an element deep")
                .advise("refine the body, raise Contact/Quadrature points, or exclude the pair"));
  }
}

template <int dim>
void Simulation<dim>::check_initial_overlap()
{
  constexpr double allowed = 0.1;
  supports->impose(0., state.displacement);
  discretization->distribute(state.displacement);
  forces.elasticity->update(state);
  double energy = 0.;
  for (const auto &contact : forces.contacts)
  {
    contact->renew(state);
    contact->update(state);
    energy += contact->energy();
  }
  if (!surface_map)
    return;
  check_obstacle_sizes();
  const contact::ContactMeasures<dim> measures = measure_contact();
  const OverlapSearch<dim> search(parameters, scene, *discretization, *surface_map, state.displacement);
  std::optional<InitialOverlap<dim>> overlap = search.find_gross(allowed);
  if (!overlap && measures.max_penetration_over_thickness > allowed)
  {
    overlap = search.find_at(measures.deepest_body, measures.deepest_position);
    overlap->thickness = measures.deepest_thickness;
    if (overlap->is_of_itself())
      overlap->depth = measures.max_penetration_over_thickness * overlap->thickness;
  }
  if (!overlap)
    return;
  const std::string depth =
      fmt::format("{:.6g} m ({:.3g} elements)", overlap->depth, overlap->depth / overlap->thickness);
  const std::string where = format_point<dim>(overlap->point);
  const std::string body = search.name(overlap->body);
  const std::string other = overlap->is_of_itself() ? "itself" : search.name(overlap->other);
  if (!parameters.contact->allow_initial_overlap)
    throw InputError(
        Complaint(fmt::format("{} overlaps {} before the run begins", body, other))
            .at(text->where(body_subsection(scene.body_names[overlap->body])))
            .found(depth + " below its surface at " + where)
            .expected(fmt::format("at most {} elements", allowed))
            .advise((overlap->is_of_itself() ? "correct its mesh, take it out of Contact/Self-contact"
                                             : fmt::format("shift {} by {}, exclude the pair", body,
                                                           format_point<dim>(search.find_shift(*overlap)))) +
                    ", or set Contact/Allow initial overlap = true"));
  progress.say(fmt::format("Initial overlap: {} in {} by {} at {}; contact stores {:.6g} J", body, other,
                           depth, where, energy));
  if (has_implicit_contact() || std::holds_alternative<ImplicitParameters>(parameters.solver))
    warn("implicit contact takes most of the energy of an initial overlap out of the motion and books it as "
         "its "
         "loss: to have it released take 'Explicit' with Contact stepping = explicit");
}

template <int dim>
double Simulation<dim>::largest_motion(double time_step) const
{
  double of_obstacles = 0.;
  for (const ObstacleMotion<dim> &motion : scene.obstacle_motions)
    of_obstacles = std::max(
        of_obstacles, (motion.displacement(state.time + time_step) - motion.displacement(state.time)).norm());
  return time_step * state.velocity.linfty_norm() + of_obstacles;
}

template <int dim>
double Simulation<dim>::limit_time_step(double time_step) const
{
  constexpr double limit = 0.5, shortest = 1e-3;
  if (!surface_map)
    return time_step;
  double thinnest = surface_map->surface().smallest_room();
  for (const auto &obstacle : scene.obstacles)
    thinnest = std::min(thinnest, obstacle->room());
  double step = time_step;
  while (step >= shortest * time_step)
  {
    const double share = limit * thinnest / largest_motion(step);
    if (!(share < 1.))
      return step;
    // A little less, as obstacles need not move evenly.
    step *= 0.99 * share;
  }
  Complaint fault =
      Complaint(fmt::format("bodies or obstacles move by {:.3g} m in one step at t = {:.6g}: they could pass "
                            "through each other unseen",
                            largest_motion(time_step), state.time))
          .expected(
              fmt::format("at most {} of the thinnest element, half body or half obstacle, {:.3g} m, or the "
                          "step is shortened, though not below {} of its length",
                          limit, thinnest, shortest))
          .advise("check speeds, loads and units, or lower Explicit/Bulk step factor");
  scene.blame_jump(state.time, state.time + time_step, fault);
  throw NumericalError(fault);
}

template <int dim>
double Simulation<dim>::penetration_limit(std::size_t term) const
{
  // The force of the volume potential turns round at a depth of about a quarter of its simplices, which may
  // be an eighth of an element.
  constexpr double share_of_volumes = 0.25;
  return parameters.contact->max_penetration * (term < forces.volume_contacts.size() ? share_of_volumes : 1.);
}

template <int dim>
std::optional<Complaint> Simulation<dim>::find_deep_penetration(const MeasuresOfTerms &measures)
{
  constexpr double warning = 0.5;
  for (std::size_t i = 0; i < measures.size(); ++i)
  {
    const bool is_of_volumes = i < forces.volume_contacts.size();
    const double limit = penetration_limit(i), depth = measures[i].max_penetration_over_thickness;
    if (depth > warning * limit && depth <= limit && !std::exchange(has_warned_of_depth, true))
      warn(fmt::format("at t = {:.6g} body '{}' has sunk into what it touches by {:.3g} of an element at {}, "
                       "under a pressure of {:.3g} Pa: at {} of an element the run will stop",
                       state.time, scene.body_names[measures[i].deepest_body], depth,
                       format_point<dim>(measures[i].deepest_position), measures[i].max_pressure, limit));
    if (depth <= limit)
      continue;
    const bool is_a_leap = depth > 2.;
    return Complaint(fmt::format("body '{}' sinks into what it touches by {:.3g} of an element at t = {:.6g}",
                                 scene.body_names[measures[i].deepest_body], depth, state.time))
        .at("at " + format_point<dim>(measures[i].deepest_position))
        .expected(
            fmt::format("at most {} of an element, {}Contact/Maximum penetration: deeper, it could pass "
                        "through",
                        limit, is_of_volumes ? "with the volume potential a quarter of " : "as in "))
        .advise(is_a_leap ? "it moves farther than an element in one step: check speeds, loads and units"
                : is_of_volumes
                    ? "raise Contact/Penalty factor, refine, load more slowly, or set Potential = surface"
                    : "raise Contact/Penalty factor, refine, or load more slowly");
  }
  return {};
}

template class Simulation<2>;
template class Simulation<3>;
} // namespace signorini
