// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/contact_problem.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

namespace signorini::contact
{
template <int dim>
ContactProblem<dim>::ContactProblem(const std::vector<SpatialVector<dim>> &nodal_masses, double step)
    : masses(nodal_masses), time_step(step)
{
}

template <int dim>
void ContactProblem<dim>::add(const LinearPoint<dim> &point, const Weights &weights)
{
  Point added;
  added.first_weight = all_weights.size();
  for (const auto &[node, weight] : weights)
  {
    const auto known = std::find_if(all_weights.begin() + added.first_weight, all_weights.end(),
                                    [node = node](const auto &entry) { return entry.first == node; });
    if (known == all_weights.end())
      all_weights.emplace_back(node, weight);
    else
      known->second += weight;
  }
  added.end_weight = all_weights.size();
  added.normal = point.normal;
  added.area = point.area;
  added.depth = point.depth;
  added.slope = point.stiffness + point.damping / time_step;
  added.offset = point.damping / time_step * std::max(point.start_depth, 0.);
  points.push_back(added);
}

template <int dim>
std::vector<double> ContactProblem<dim>::pack() const
{
  std::vector<double> packed;
  for (const Point &point : points)
  {
    packed.insert(packed.end(), {static_cast<double>(point.end_weight - point.first_weight), point.area,
                                 point.depth, point.slope, point.offset});
    packed.insert(packed.end(), point.normal.begin(), point.normal.end());
    for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
      packed.insert(packed.end(), {static_cast<double>(all_weights[i].first), all_weights[i].second});
  }
  return packed;
}

template <int dim>
void ContactProblem<dim>::add_packed(const std::vector<double> &packed)
{
  for (auto value = packed.begin(); value != packed.end();)
  {
    Point point;
    point.first_weight = all_weights.size();
    point.end_weight = point.first_weight + static_cast<std::size_t>(*value++);
    for (double *number : {&point.area, &point.depth, &point.slope, &point.offset})
      *number = *value++;
    for (double &component : point.normal)
      component = *value++;
    while (all_weights.size() < point.end_weight)
    {
      const auto node = static_cast<unsigned int>(*value++);
      all_weights.emplace_back(node, *value++);
    }
    points.push_back(point);
  }
}

template <int dim>
void ContactProblem<dim>::number_unknowns()
{
  nodes.clear();
  for (const auto &[node, weight] : all_weights)
    nodes.push_back(node);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  position.assign(masses.size(), 0);
  inertia.setZero(static_cast<Eigen::Index>(dim * nodes.size()));
  for (unsigned int i = 0; i < nodes.size(); ++i)
  {
    position[nodes[i]] = i;
    for (unsigned int d = 0; d < dim; ++d)
      if (std::isfinite(masses[nodes[i]][d]))
        inertia[dim * i + d] = masses[nodes[i]][d] / (time_step * time_step);
  }
}

template <int dim>
double ContactProblem<dim>::project(const Point &point, const Vector &values) const
{
  double sum = 0.;
  for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
    sum += all_weights[i].second *
           point.normal.dot(values.template segment<dim>(dim * position[all_weights[i].first]));
  return sum;
}

template <int dim>
void ContactProblem<dim>::add_along(const Point &point, double factor, Vector &values) const
{
  for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
    values.template segment<dim>(dim * position[all_weights[i].first]) +=
        factor * all_weights[i].second * point.normal;
}

template <int dim>
std::vector<double> ContactProblem<dim>::compute_pressures(const Vector &increment) const
{
  std::vector<double> pressures;
  pressures.reserve(points.size());
  for (const Point &point : points)
    pressures.push_back(point.slope * (point.depth - project(point, increment)) - point.offset);
  return pressures;
}

template <int dim>
auto ContactProblem<dim>::compute_gradient(const Vector &increment,
                                           const std::vector<double> &pressures) const -> Vector
{
  Vector gradient = inertia.cwiseProduct(increment);
  for (std::size_t q = 0; q < points.size(); ++q)
    if (pressures[q] > 0.)
      add_along(points[q], -points[q].area * pressures[q], gradient);
  return (inertia.array() > 0.).select(gradient, 0.);
}

template <int dim>
double ContactProblem<dim>::compute_objective(const Vector &increment,
                                              const std::vector<double> &pressures) const
{
  double sum = 0.5 * increment.dot(inertia.cwiseProduct(increment));
  for (std::size_t q = 0; q < points.size(); ++q)
    sum += 0.5 * points[q].area * std::pow(std::max(pressures[q], 0.), 2) / points[q].slope;
  return sum;
}

template <int dim>
bool ContactProblem<dim>::have_same_nodes(const Point &one, const Point &other) const
{
  return std::equal(all_weights.begin() + one.first_weight, all_weights.begin() + one.end_weight,
                    all_weights.begin() + other.first_weight, all_weights.begin() + other.end_weight,
                    [](const auto &a, const auto &b) { return a.first == b.first; });
}

template <int dim>
void ContactProblem<dim>::add_block(std::size_t first_point, std::size_t end_point,
                                    const std::vector<double> &pressures,
                                    std::vector<Eigen::Triplet<double>> &entries) const
{
  const Point &model = points[first_point];
  const std::size_t n_nodes = model.end_weight - model.first_weight;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(dim * n_nodes, dim * n_nodes);
  Vector direction(dim * n_nodes);
  bool is_active = false;
  for (std::size_t q = first_point; q < end_point; ++q)
  {
    if (!(pressures[q] > 0.))
      continue;
    is_active = true;
    for (std::size_t a = 0; a < n_nodes; ++a)
      direction.template segment<dim>(dim * a) =
          all_weights[points[q].first_weight + a].second * points[q].normal;
    block.template selfadjointView<Eigen::Lower>().rankUpdate(direction, points[q].area * points[q].slope);
  }
  if (!is_active)
    return;
  const auto unknown = [&](std::size_t i)
  { return dim * position[all_weights[model.first_weight + i / dim].first] + i % dim; };
  for (std::size_t j = 0; j < dim * n_nodes; ++j)
    for (std::size_t i = j; i < dim * n_nodes; ++i)
    {
      const auto row = unknown(i), column = unknown(j);
      if (inertia[row] > 0. && inertia[column] > 0.)
        entries.emplace_back(std::max(row, column), std::min(row, column), block(i, j));
    }
}

template <int dim>
Eigen::SparseMatrix<double> ContactProblem<dim>::assemble(const std::vector<double> &pressures) const
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < inertia.size(); ++i)
    entries.emplace_back(i, i, inertia[i] > 0. ? inertia[i] : 1.);
  std::size_t first = 0;
  for (std::size_t q = 1; q <= points.size(); ++q)
    if (q == points.size() || !have_same_nodes(points[first], points[q]))
    {
      add_block(first, q, pressures, entries);
      first = q;
    }
  Eigen::SparseMatrix<double> matrix(inertia.size(), inertia.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <int dim>
double ContactProblem<dim>::find_length(const Vector &increment, const Vector &direction,
                                        const std::vector<double> &pressures) const
{
  // The derivative of J along the direction grows, piecewise linearly: halve the interval it changes sign in.
  constexpr unsigned int n_halvings = 60;
  std::vector<double> rates;
  for (const Point &point : points)
    rates.push_back(project(point, direction));
  const double first = direction.dot(inertia.cwiseProduct(increment)),
               second = direction.dot(inertia.cwiseProduct(direction));
  const auto derivative = [&](double length)
  {
    double sum = first + length * second;
    for (std::size_t q = 0; q < points.size(); ++q)
      sum -= points[q].area * rates[q] * std::max(pressures[q] - length * points[q].slope * rates[q], 0.);
    return sum;
  };
  double low = 0., high = 1.;
  if (derivative(high) <= 0.)
    return high;
  for (unsigned int i = 0; i < n_halvings; ++i)
    (derivative(0.5 * (low + high)) > 0. ? high : low) = 0.5 * (low + high);
  return high;
}

template <int dim>
auto ContactProblem<dim>::solve() -> std::optional<Increments>
{
  constexpr unsigned int max_n_iterations = 100;
  constexpr double tolerance = 1e-24; // of energies: 1e-12 of increments
  number_unknowns();
  Vector increment = Vector::Zero(inertia.size());
  std::vector<double> pressures = compute_pressures(increment);
  const double energy = compute_objective(increment, pressures);
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
  const auto is_same_set = [](const std::vector<double> &one, const std::vector<double> &other)
  {
    return std::equal(one.begin(), one.end(), other.begin(),
                      [](double a, double b) { return (a > 0.) == (b > 0.); });
  };
  bool is_solved = !(energy > 0.);
  for (n_iterations_ = 0; !is_solved && n_iterations_ < max_n_iterations; ++n_iterations_)
  {
    const Vector gradient = compute_gradient(increment, pressures);
    factors.compute(assemble(pressures));
    const Vector direction = -factors.solve(gradient);
    std::vector<double> new_pressures = compute_pressures(increment + direction);
    is_solved = is_same_set(pressures, new_pressures) || -gradient.dot(direction) <= tolerance * energy;
    const double length = is_solved ? 1. : find_length(increment, direction, pressures);
    increment += length * direction;
    pressures = length == 1. ? new_pressures : compute_pressures(increment);
  }
  if (!is_solved || !increment.allFinite())
    return {};
  Increments all(masses.size(), SpatialVector<dim>::Zero());
  for (unsigned int i = 0; i < nodes.size(); ++i)
    all[nodes[i]] = increment.template segment<dim>(dim * i);
  return all;
}

template class ContactProblem<2>;
template class ContactProblem<3>;
} // namespace signorini::contact
