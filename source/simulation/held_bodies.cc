// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/held_bodies.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/contact_parameters.h"

#include <Eigen/Dense>

#include <fmt/core.h>

#include <algorithm>
#include <numeric>

namespace signorini
{
namespace
{
constexpr unsigned int n_rigid_motions(int dim)
{
  return dim == 2 ? 3 : 6;
}

/// Component of every rigid motion at a point: dim translations, then the rotations.
template <int dim>
Eigen::VectorXd rigid_motions(const dealii::Tensor<1, dim> &arm, unsigned int component)
{
  Eigen::VectorXd motions = Eigen::VectorXd::Zero(n_rigid_motions(dim));
  motions[component] = 1.;
  if (dim == 2)
    motions[2] = component == 0 ? -arm[1] : arm[0];
  else
    for (unsigned int axis = 0; axis < 3; ++axis)
    {
      if (component == (axis + 1) % 3)
        motions[3 + axis] = -arm[(axis + 2) % 3];
      if (component == (axis + 2) % 3)
        motions[3 + axis] = arm[(axis + 1) % 3];
    }
  return motions;
}

bool may_touch(const Parameters &parameters, const std::string &one, const std::string &other)
{
  return parameters.contact && !is_pair_excluded(*parameters.contact, one, other);
}

bool may_touch_obstacle(const Parameters &parameters, const std::string &body)
{
  return std::any_of(parameters.obstacles.begin(), parameters.obstacles.end(),
                     [&](const auto &obstacle) { return may_touch(parameters, body, obstacle.name); });
}

bool may_touch_something(const Parameters &parameters, const unsigned int body)
{
  const std::string &name = parameters.bodies[body].name;
  return may_touch_obstacle(parameters, name) ||
         std::any_of(parameters.bodies.begin(), parameters.bodies.end(),
                     [&](const BodyParameters &other)
                     { return other.name != name && may_touch(parameters, name, other.name); });
}

/// The bodies that may touch the last one of `unseen`, or one that may touch such a one, and so on; they are
/// taken out of `unseen`.
std::vector<unsigned int> take_group(const Parameters &parameters, std::vector<unsigned int> &unseen)
{
  std::vector<unsigned int> group{unseen.back()};
  unseen.pop_back();
  for (std::size_t next = 0; next < group.size(); ++next)
  {
    const std::string &body = parameters.bodies[group[next]].name;
    const auto apart =
        std::stable_partition(unseen.begin(), unseen.end(),
                              [&](const unsigned int other)
                              { return !may_touch(parameters, body, parameters.bodies[other].name); });
    group.insert(group.end(), apart, unseen.end());
    unseen.erase(apart, unseen.end());
  }
  return group;
}

/// Throws for a group of bodies that only touch each other, none of which has a support.
template <int dim>
void check_groups(const Parameters &parameters, const Scene<dim> &scene)
{
  std::vector<bool> is_anchored(scene.n_bodies());
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    is_anchored[body] = may_touch_obstacle(parameters, scene.body_names[body]);
  for (const Support<dim> &support : scene.supports)
    is_anchored[support.body] = true;
  std::vector<unsigned int> unseen(scene.n_bodies());
  std::iota(unseen.rbegin(), unseen.rend(), 0u);
  while (!unseen.empty())
  {
    const std::vector<unsigned int> group = take_group(parameters, unseen);
    if (group.size() == 1 ||
        std::any_of(group.begin(), group.end(), [&](const unsigned int body) { return is_anchored[body]; }))
      continue;
    throw InputError(Complaint(fmt::format("body '{}' and all that it can touch are free to move together: "
                                           "none of them has a support or can touch an obstacle",
                                           scene.body_names[group.front()]))
                         .at("subsection Body " + scene.body_names[group.front()])
                         .found(fmt::format("a group of {} bodies", group.size()))
                         .advise("add a subsection Support to one of them, or an obstacle to lean on"));
  }
}
} // namespace

template <int dim>
std::vector<bool> find_held_bodies(const Scene<dim> &scene, const SupportedDofs<dim> &supports)
{
  std::vector<dealii::Tensor<1, dim>> centres(scene.n_bodies());
  std::vector<double> lengths(scene.n_bodies(), 0.);
  std::vector<unsigned int> counts(scene.n_bodies(), 0);
  const auto body_of = [&](const auto &entry) { return scene.supports[entry.support].body; };
  for (const auto &entry : supports.entries())
  {
    centres[body_of(entry)] += entry.position;
    ++counts[body_of(entry)];
  }
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    if (counts[body] > 0)
      centres[body] /= counts[body];
  for (const auto &entry : supports.entries())
    lengths[body_of(entry)] =
        std::max(lengths[body_of(entry)], (entry.position - centres[body_of(entry)]).norm());

  const unsigned int n = n_rigid_motions(dim);
  std::vector<Eigen::MatrixXd> gram(scene.n_bodies(), Eigen::MatrixXd::Zero(n, n));
  for (const auto &entry : supports.entries())
  {
    const unsigned int body = body_of(entry);
    const dealii::Tensor<1, dim> arm = (entry.position - centres[body]) / std::max(lengths[body], 1e-300);
    const Eigen::VectorXd motions = rigid_motions<dim>(arm, scene.supports[entry.support].component);
    gram[body] += motions * motions.transpose() / counts[body];
  }
  std::vector<bool> is_held;
  for (const Eigen::MatrixXd &matrix : gram)
    is_held.push_back(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues()[0] > 1e-8);
  return is_held;
}

template <int dim>
void check_held(const Parameters &parameters, const Scene<dim> &scene, const std::vector<bool> &is_held)
{
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
    if (!is_held[body] && !may_touch_something(parameters, body))
      throw InputError(
          Complaint("body '" + scene.body_names[body] +
                    "' is free to move: its supports leave a rigid motion and it can touch nothing that "
                    "would hold it")
              .at("subsection Body " + scene.body_names[body])
              .advise("add a subsection Support, or a subsection Contact with something to lean on"));
  check_groups(parameters, scene);
}

template std::vector<bool> find_held_bodies<2>(const Scene<2> &, const SupportedDofs<2> &);
template std::vector<bool> find_held_bodies<3>(const Scene<3> &, const SupportedDofs<3> &);
template void check_held<2>(const Parameters &, const Scene<2> &, const std::vector<bool> &);
template void check_held<3>(const Parameters &, const Scene<3> &, const std::vector<bool> &);
} // namespace signorini
