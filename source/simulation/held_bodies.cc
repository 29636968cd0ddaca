// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/held_bodies.h"

#include "signorini/base/exceptions.h"
#include "signorini/parameters/body_parameters.h"
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

template <int dim>
using Entries = std::vector<typename SupportedDofs<dim>::Entry>;

/// Those of each body.
template <int dim>
std::vector<Entries<dim>> sort_by_body(const Scene<dim> &scene, const SupportedDofs<dim> &supports)
{
  std::vector<Entries<dim>> of_bodies(scene.n_bodies());
  for (const auto &entry : supports.entries())
    of_bodies[scene.supports[entry.support].body].push_back(entry);
  return of_bodies;
}

/// Gram matrix of the rigid motions at supported degrees of freedom of some bodies, moved together.
/// Lengths are measured by the distance of the supported points, so that shifts and rotations compare.
template <int dim>
Eigen::MatrixXd make_gram_matrix(const Scene<dim> &scene, const Entries<dim> &entries)
{
  dealii::Tensor<1, dim> centre;
  for (const auto &entry : entries)
    centre += entry.position;
  if (!entries.empty())
    centre /= entries.size();
  double length = 1e-300;
  for (const auto &entry : entries)
    length = std::max(length, (entry.position - centre).norm());
  Eigen::MatrixXd gram = Eigen::MatrixXd::Zero(n_rigid_motions(dim), n_rigid_motions(dim));
  for (const auto &entry : entries)
  {
    const Eigen::VectorXd motions =
        rigid_motions<dim>((entry.position - centre) / length, scene.supports[entry.support].component);
    gram += motions * motions.transpose() / entries.size();
  }
  return gram;
}

constexpr double smallest_eigenvalue = 1e-8;

bool has_full_rank(const Eigen::MatrixXd &gram)
{
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(gram).eigenvalues()[0] > smallest_eigenvalue;
}

/// Names rigid motions that supports leave free.
template <int dim>
std::string describe_free_motions(const Eigen::MatrixXd &gram)
{
  std::string shifts;
  for (unsigned int d = 0; d < dim; ++d)
    if (gram(d, d) < smallest_eigenvalue)
      shifts += (shifts.empty() ? "" : ", ") + std::string(1, "xyz"[d]);
  return shifts.empty() ? "a rotation" : "a shift along " + shifts;
}

/// Contact within a group of bodies stops no motion of them all together: their supports must.
template <int dim>
void check_groups(const ParameterText &text, const Parameters &parameters, const Scene<dim> &scene,
                  const std::vector<Entries<dim>> &entries_of_bodies)
{
  std::vector<unsigned int> unseen(scene.n_bodies());
  std::iota(unseen.rbegin(), unseen.rend(), 0u);
  while (!unseen.empty())
  {
    const std::vector<unsigned int> group = take_group(parameters, unseen);
    if (group.size() == 1 || std::any_of(group.begin(), group.end(),
                                         [&](const unsigned int body)
                                         { return may_touch_obstacle(parameters, scene.body_names[body]); }))
      continue;
    Entries<dim> entries;
    for (const unsigned int body : group)
      entries.insert(entries.end(), entries_of_bodies[body].begin(), entries_of_bodies[body].end());
    const Eigen::MatrixXd gram = make_gram_matrix(scene, entries);
    if (has_full_rank(gram))
      continue;
    const std::string &first = scene.body_names[group.front()];
    throw InputError(
        Complaint(fmt::format("body '{}' and all that it can touch are free to move together: their supports "
                              "leave {} of all of them, and none can touch an obstacle",
                              first, describe_free_motions<dim>(gram)))
            .at(text.where(body_subsection(first)))
            .found(fmt::format("a group of {} bodies", group.size()))
            .advise("add a subsection Support to one of them, or an obstacle to lean on"));
  }
}
} // namespace

template <int dim>
std::vector<bool> find_held_bodies(const Scene<dim> &scene, const SupportedDofs<dim> &supports)
{
  std::vector<bool> is_held;
  for (const Entries<dim> &entries : sort_by_body(scene, supports))
    is_held.push_back(has_full_rank(make_gram_matrix(scene, entries)));
  return is_held;
}

template <int dim>
void check_held(const ParameterText &text, const Parameters &parameters, const Scene<dim> &scene,
                const SupportedDofs<dim> &supports)
{
  const std::vector<Entries<dim>> entries = sort_by_body(scene, supports);
  for (unsigned int body = 0; body < scene.n_bodies(); ++body)
  {
    const Eigen::MatrixXd gram = make_gram_matrix(scene, entries[body]);
    if (!has_full_rank(gram) && !may_touch_something(parameters, body))
      throw InputError(
          Complaint(
              fmt::format("body '{}' is free to move: its supports leave {} and it can touch nothing that "
                          "would hold it",
                          scene.body_names[body], describe_free_motions<dim>(gram)))
              .at(text.where(body_subsection(scene.body_names[body])))
              .advise("add a subsection Support, or a subsection Contact with something to lean on"));
  }
  check_groups(text, parameters, scene, entries);
}

template std::vector<bool> find_held_bodies<2>(const Scene<2> &, const SupportedDofs<2> &);
template std::vector<bool> find_held_bodies<3>(const Scene<3> &, const SupportedDofs<3> &);
template void check_held<2>(const ParameterText &, const Parameters &, const Scene<2> &,
                            const SupportedDofs<2> &);
template void check_held<3>(const ParameterText &, const Parameters &, const Scene<3> &,
                            const SupportedDofs<3> &);
} // namespace signorini
