// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/contact/potential/contact_problem.h"

#include "signorini/contact/potential/coulomb_law.h"

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
  for (const Weight &weight : weights)
  {
    const auto known = std::find_if(all_weights.begin() + added.first_weight, all_weights.end(),
                                    [&](const Weight &other) { return other.node == weight.node; });
    if (known == all_weights.end())
      all_weights.push_back(weight);
    else
    {
      known->share += weight.share;
      known->lever += weight.lever;
    }
  }
  added.end_weight = all_weights.size();
  added.normal = point.normal;
  added.area = point.area;
  added.depth = point.depth;
  added.slope = point.stiffness + point.damping / time_step;
  added.offset = point.damping / time_step * std::max(point.start_depth, 0.);
  added.stiffness = point.stiffness;
  added.coefficient = point.slip.coefficient;
  added.trial = point.slip.trial;
  points.push_back(added);
}

template <int dim>
std::vector<double> ContactProblem<dim>::pack() const
{
  std::vector<double> packed;
  const auto append = [&packed](const SpatialVector<dim> &vector)
  { packed.insert(packed.end(), vector.begin(), vector.end()); };
  for (const Point &point : points)
  {
    packed.insert(packed.end(), {static_cast<double>(point.end_weight - point.first_weight), point.area,
                                 point.depth, point.slope, point.offset, point.stiffness, point.coefficient});
    append(point.normal);
    append(point.trial);
    for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
    {
      packed.insert(packed.end(), {static_cast<double>(all_weights[i].node), all_weights[i].share});
      if (point.coefficient > 0.)
        append(all_weights[i].lever);
    }
  }
  return packed;
}

template <int dim>
void ContactProblem<dim>::add_packed(const std::vector<double> &packed,
                                     const std::function<unsigned int(unsigned int)> &number)
{
  auto value = packed.begin();
  const auto take = [&value](SpatialVector<dim> &vector)
  {
    for (double &component : vector)
      component = *value++;
  };
  while (value != packed.end())
  {
    Point point;
    point.first_weight = all_weights.size();
    point.end_weight = point.first_weight + static_cast<std::size_t>(*value++);
    for (double *scalar :
         {&point.area, &point.depth, &point.slope, &point.offset, &point.stiffness, &point.coefficient})
      *scalar = *value++;
    take(point.normal);
    take(point.trial);
    while (all_weights.size() < point.end_weight)
    {
      const unsigned int node = number(static_cast<unsigned int>(*value++));
      Weight weight(node, *value++);
      if (point.coefficient > 0.)
        take(weight.lever);
      all_weights.push_back(weight);
    }
    points.push_back(point);
  }
}

template <int dim>
void ContactProblem<dim>::number_unknowns()
{
  nodes.clear();
  for (const Weight &weight : all_weights)
    nodes.push_back(weight.node);
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
SpatialVector<dim> ContactProblem<dim>::project(const Point &point, const Vector &values) const
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
  {
    const Weight &weight = all_weights[i];
    const SpatialVector<dim> value = values.template segment<dim>(dim * position[weight.node]);
    sum += weight.share * value + point.normal.dot(value) * weight.lever;
  }
  return sum;
}

template <int dim>
void ContactProblem<dim>::add_force(const Point &point, const SpatialVector<dim> &force, Vector &values) const
{
  for (std::size_t i = point.first_weight; i < point.end_weight; ++i)
  {
    const Weight &weight = all_weights[i];
    values.template segment<dim>(dim * position[weight.node]) +=
        weight.share * force + weight.lever.dot(force) * point.normal;
  }
}

template <int dim>
auto ContactProblem<dim>::compute_strains(const Vector &increment) const -> Strains
{
  Strains strains;
  strains.reserve(points.size());
  for (const Point &point : points)
  {
    const SpatialVector<dim> moved = project(point, increment);
    const double along = point.normal.dot(moved);
    strains.push_back(
        {point.slope * (point.depth - along) - point.offset, point.trial + moved - along * point.normal});
  }
  return strains;
}

template <int dim>
SpatialVector<dim> ContactProblem<dim>::find_elastic_slip(const Point &point, const SpatialVector<dim> &slip,
                                                          double pressure)
{
  return CoulombLaw{point.coefficient, point.stiffness}.find_elastic_slip(slip, std::max(pressure, 0.));
}

template <int dim>
SpatialTensor<dim> ContactProblem<dim>::compute_stiffness(const Point &point, const Strain &strain)
{
  const SpatialTensor<dim> along = point.normal * point.normal.transpose();
  const auto elastic =
      CoulombLaw{point.coefficient, point.stiffness}.differentiate<dim>(strain.slip, strain.pressure);
  return point.slope * along + point.stiffness * elastic.by_trial * (SpatialTensor<dim>::Identity() - along);
}

template <int dim>
auto ContactProblem<dim>::compute_gradient(const Vector &increment, const Strains &strains) const -> Vector
{
  Vector gradient = inertia.cwiseProduct(increment);
  for (std::size_t q = 0; q < points.size(); ++q)
    if (strains[q].is_pressing())
    {
      const Point &point = points[q];
      const SpatialVector<dim> slip = find_elastic_slip(point, strains[q].slip, strains[q].pressure);
      add_force(point, point.area * (point.stiffness * slip - strains[q].pressure * point.normal), gradient);
    }
  return (inertia.array() > 0.).select(gradient, 0.);
}

template <int dim>
double ContactProblem<dim>::compute_energy(const Strains &strains) const
{
  double sum = 0.;
  for (std::size_t q = 0; q < points.size(); ++q)
    sum += 0.5 * points[q].area * std::pow(std::max(strains[q].pressure, 0.), 2) / points[q].slope;
  return sum;
}

template <int dim>
bool ContactProblem<dim>::have_same_nodes(const Point &one, const Point &other) const
{
  return std::equal(all_weights.begin() + one.first_weight, all_weights.begin() + one.end_weight,
                    all_weights.begin() + other.first_weight, all_weights.begin() + other.end_weight,
                    [](const Weight &a, const Weight &b) { return a.node == b.node; });
}

template <int dim>
void ContactProblem<dim>::add_block(std::size_t first_point, std::size_t end_point, const Strains &strains,
                                    std::vector<Eigen::Triplet<double>> &entries) const
{
  const Point &model = points[first_point];
  const std::size_t n_nodes = model.end_weight - model.first_weight;
  Eigen::MatrixXd block = Eigen::MatrixXd::Zero(dim * n_nodes, dim * n_nodes);
  Vector along(dim * n_nodes);
  Factors factors(dim * n_nodes, dim);
  bool is_active = false;
  for (std::size_t q = first_point; q < end_point; ++q)
  {
    const Point &point = points[q];
    if (!strains[q].is_pressing())
      continue;
    is_active = true;
    for (std::size_t a = 0; a < n_nodes; ++a)
    {
      const Weight &weight = all_weights[point.first_weight + a];
      along.template segment<dim>(dim * a) = weight.share * point.normal;
      factors.template middleRows<dim>(dim * a) =
          weight.share * SpatialTensor<dim>::Identity() + point.normal * weight.lever.transpose();
    }
    if (point.coefficient > 0.)
      block.noalias() += point.area * factors * compute_stiffness(point, strains[q]) * factors.transpose();
    else
      block.template selfadjointView<Eigen::Lower>().rankUpdate(along, point.area * point.slope);
  }
  if (!is_active)
    return;
  const auto unknown = [&](std::size_t i)
  { return dim * position[all_weights[model.first_weight + i / dim].node] + i % dim; };
  for (std::size_t j = 0; j < dim * n_nodes; ++j)
    for (std::size_t i = j; i < dim * n_nodes; ++i)
    {
      const auto row = unknown(i), column = unknown(j);
      if (inertia[row] > 0. && inertia[column] > 0.)
        entries.emplace_back(std::max(row, column), std::min(row, column), block(i, j));
    }
}

template <int dim>
Eigen::SparseMatrix<double> ContactProblem<dim>::assemble(const Strains &strains) const
{
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < inertia.size(); ++i)
    entries.emplace_back(i, i, inertia[i] > 0. ? inertia[i] : 1.);
  std::size_t first = 0;
  for (std::size_t q = 1; q <= points.size(); ++q)
    if (q == points.size() || !have_same_nodes(points[first], points[q]))
    {
      add_block(first, q, strains, entries);
      first = q;
    }
  Eigen::SparseMatrix<double> matrix(inertia.size(), inertia.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

template <int dim>
double ContactProblem<dim>::find_length(const Vector &increment, const Vector &direction,
                                        const Strains &strains) const
{
  // The derivative of J along the direction grows all the way: halve the interval it changes sign in.
  constexpr unsigned int n_halvings = 60;
  std::vector<SpatialVector<dim>> rates;
  for (const Point &point : points)
    rates.push_back(project(point, direction));
  const double first = direction.dot(inertia.cwiseProduct(increment)),
               second = direction.dot(inertia.cwiseProduct(direction));
  const auto derivative = [&](double length)
  {
    double sum = first + length * second;
    for (std::size_t q = 0; q < points.size(); ++q)
    {
      const Point &point = points[q];
      const double rate = point.normal.dot(rates[q]);
      sum -= point.area * rate * std::max(strains[q].pressure - length * point.slope * rate, 0.);
      const SpatialVector<dim> across = rates[q] - rate * point.normal;
      sum += point.area * point.stiffness *
             across.dot(find_elastic_slip(point, strains[q].slip + length * across, strains[q].pressure));
    }
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
bool ContactProblem<dim>::have_settled(const Strains &before, const Strains &after) const
{
  constexpr double tolerance = 1e-8; // of the widest cone
  double widest = 0., change = 0.;
  for (std::size_t q = 0; q < points.size(); ++q)
  {
    const Point &point = points[q];
    const Strain &one = before[q], &other = after[q];
    if (!(point.coefficient > 0.) || !(one.is_pressing() || other.is_pressing()))
      continue;
    SpatialVector<dim> foretold = SpatialVector<dim>::Zero();
    if (one.is_pressing())
      foretold = point.stiffness * find_elastic_slip(point, one.slip, one.pressure) +
                 compute_stiffness(point, one) * (other.slip - one.slip);
    widest = std::max({widest, point.coefficient * one.pressure, point.coefficient * other.pressure});
    change = std::max(
        change, (point.stiffness * find_elastic_slip(point, other.slip, other.pressure) - foretold).norm());
  }
  return change <= tolerance * widest;
}

template <int dim>
auto ContactProblem<dim>::solve() -> std::optional<Increments>
{
  constexpr unsigned int max_n_iterations = 100;
  constexpr double tolerance = 1e-24; // of energies: 1e-12 of increments
  number_unknowns();
  Vector increment = Vector::Zero(inertia.size());
  Strains strains = compute_strains(increment);
  const double energy = compute_energy(strains);
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> factors;
  const auto is_same_set = [](const Strains &one, const Strains &other)
  {
    return std::equal(one.begin(), one.end(), other.begin(),
                      [](const Strain &a, const Strain &b) { return a.is_pressing() == b.is_pressing(); });
  };
  bool is_solved = !(energy > 0.);
  for (n_iterations_ = 0; !is_solved && n_iterations_ < max_n_iterations; ++n_iterations_)
  {
    const Vector gradient = compute_gradient(increment, strains);
    factors.compute(assemble(strains));
    const Vector direction = -factors.solve(gradient);
    Strains new_strains = compute_strains(increment + direction);
    is_solved = (is_same_set(strains, new_strains) || -gradient.dot(direction) <= tolerance * energy) &&
                have_settled(strains, new_strains);
    const double length = is_solved ? 1. : find_length(increment, direction, strains);
    increment += length * direction;
    strains = length == 1. ? new_strains : compute_strains(increment);
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
