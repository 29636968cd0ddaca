// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/discretization/simplex_field.h"

#include <deal.II/base/mpi.h>

#include <Eigen/LU>

#include <boost/geometry.hpp>

#include <limits>

namespace signorini
{
namespace
{
/// The own tetrahedra, each as its body, its corners and the nodal values of all fields.
template <int dim>
std::vector<double> pack_own_cells(const Discretization<dim> &discretization,
                                   const std::vector<const Vector *> &fields)
{
  std::vector<double> packed;
  const CellTable<dim> &cells = discretization.cells;
  const auto append = [&](const Vector &field, const unsigned int *dofs, unsigned int n)
  {
    for (unsigned int i = 0; i < n; ++i)
      packed.push_back(field.local_element(dofs[i]));
  };
  for (unsigned int cell = discretization.tetrahedra->first_cell; cell < cells.n_cells; ++cell)
  {
    packed.push_back(cells.bodies[cell]);
    append(discretization.node_positions, cells.cell_dofs(cell), (dim + 1) * dim);
    for (const Vector *field : fields)
      append(*field, cells.cell_dofs(cell), cells.n_cell_dofs(cell));
  }
  return packed;
}

template <typename BoostPoint, int dim>
BoostPoint to_boost(const SpatialVector<dim> &x)
{
  BoostPoint point;
  boost::geometry::set<0>(point, x[0]);
  boost::geometry::set<1>(point, x[1]);
  if constexpr (dim == 3)
    boost::geometry::set<2>(point, x[2]);
  return point;
}

/// Values of the shape functions at barycentric coordinates: corners, then edges as deal.II numbers them.
template <int dim>
std::vector<double> shape_values(unsigned int degree, const Eigen::Matrix<double, dim + 1, 1> &lambda)
{
  if (degree == 1)
    return {lambda.data(), lambda.data() + dim + 1};
  static const std::array<std::array<unsigned int, 2>, 6> edges{
      {{{0, 1}}, {{1, 2}}, {{2, 0}}, {{0, 3}}, {{1, 3}}, {{2, 3}}}};
  std::vector<double> values;
  for (unsigned int v = 0; v <= dim; ++v)
    values.push_back(lambda[v] * (2. * lambda[v] - 1.));
  for (unsigned int e = 0; e < (dim == 2 ? 3 : 6); ++e)
    values.push_back(4. * lambda[edges[e][0]] * lambda[edges[e][1]]);
  return values;
}
} // namespace

template <int dim>
SimplexField<dim>::SimplexField(const Discretization<dim> &discretization,
                                const std::vector<const Vector *> &fields)
    : n_fields(fields.size()), n_nodes(discretization.tetrahedra->element.n_dofs_per_cell() / dim),
      degree(discretization.degree)
{
  std::vector<std::vector<std::pair<Box, unsigned int>>> boxes;
  for (const std::vector<double> &packed : dealii::Utilities::MPI::all_gather(
           discretization.communicator(), pack_own_cells(discretization, fields)))
    add_cells_of_rank(packed, boxes);
  for (const auto &of_body : boxes)
    trees.emplace_back(of_body);
}

template <int dim>
void SimplexField<dim>::add_cells_of_rank(const std::vector<double> &packed,
                                          std::vector<std::vector<std::pair<Box, unsigned int>>> &boxes)
{
  for (auto value = packed.begin(); value != packed.end();)
  {
    const auto body = static_cast<std::size_t>(*value++);
    Eigen::Matrix<double, dim + 1, dim + 1> corners; // one a column, with 1 below
    corners.row(dim).setOnes();
    for (unsigned int v = 0; v <= dim; ++v)
      for (unsigned int d = 0; d < dim; ++d)
        corners(d, v) = *value++;
    const SpatialVector<dim> least = corners.template topRows<dim>().rowwise().minCoeff(),
                             most = corners.template topRows<dim>().rowwise().maxCoeff();
    const SpatialVector<dim> margin = SpatialVector<dim>::Constant(0.1 * (most - least).maxCoeff());

    const Eigen::Matrix<double, dim + 1, dim + 1> inverse = corners.inverse();
    boxes.resize(std::max(boxes.size(), body + 1));
    boxes[body].emplace_back(
        Box(to_boost<BoostPoint, dim>(least - margin), to_boost<BoostPoint, dim>(most + margin)),
        static_cast<unsigned int>(cells.size()));
    cells.push_back({inverse.template leftCols<dim>(), inverse.col(dim), values.size()});
    for (unsigned int i = 0; i < n_fields * n_nodes; ++i, value += dim)
      values.push_back(Eigen::Map<const SpatialVector<dim>>(&*value));
  }
}

template <int dim>
typename SimplexField<dim>::Barycentric SimplexField<dim>::coordinates(unsigned int cell,
                                                                       const SpatialVector<dim> &x) const
{
  return cells[cell].slopes * x + cells[cell].offset;
}

template <int dim>
unsigned int SimplexField<dim>::find_cell(unsigned int body, const SpatialVector<dim> &x) const
{
  namespace index = boost::geometry::index;
  constexpr unsigned int n_near = 16;
  const BoostPoint point = to_boost<BoostPoint, dim>(x);
  unsigned int best = 0;
  double least_outside = std::numeric_limits<double>::max();
  const auto look_at = [&](const auto &predicate)
  {
    for (auto found = index::qbegin(trees[body], predicate); found != index::qend(trees[body]); ++found)
    {
      const double outside = -coordinates(found->second, x).minCoeff();
      if (outside < least_outside)
      {
        least_outside = outside;
        best = found->second;
      }
    }
  };
  look_at(index::intersects(point));
  if (least_outside == std::numeric_limits<double>::max())
    look_at(index::nearest(point, n_near));
  return best;
}

template <int dim>
std::vector<SpatialVector<dim>> SimplexField<dim>::evaluate(unsigned int body,
                                                            const dealii::Point<dim> &x) const
{
  SpatialVector<dim> position;
  for (unsigned int d = 0; d < dim; ++d)
    position[d] = x[d];
  const unsigned int cell = find_cell(body, position);
  const std::vector<double> shape = shape_values<dim>(degree, coordinates(cell, position));
  std::vector<SpatialVector<dim>> result(n_fields, SpatialVector<dim>::Zero());
  for (unsigned int field = 0; field < n_fields; ++field)
    for (unsigned int node = 0; node < n_nodes; ++node)
      result[field] += shape[node] * values[cells[cell].first_value + field * n_nodes + node];
  return result;
}

template class SimplexField<2>;
template class SimplexField<3>;
} // namespace signorini
