// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/remeshing.h"

#include "signorini/adaptivity/error_classes.h"
#include "signorini/base/to_point.h"
#include "signorini/discretization/simplex_field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace signorini
{
namespace
{
/// The edge length that Gmsh would have been asked for to make an own cell as large as it is [m].
template <int dim>
double size_of_cell(const CellTable<dim> &cells, unsigned int cell)
{
  const double *measures = cells.cell_nodal_measures(cell);
  const double volume = std::accumulate(measures, measures + cells.n_nodes(cell), 0.);
  return std::pow(n_cells_of_cube(dim) * volume, 1. / dim);
}

/// By what the edges of each own cell are to be multiplied.
template <int dim>
std::vector<double> find_factors(const ErrorEstimate &estimate, const AdaptivityParameters &adaptivity,
                                 const Discretization<dim> &discretization)
{
  std::vector<double> factors(discretization.cells.n_cells, 1.);
  const ErrorClasses errors(estimate, adaptivity, discretization.communicator());
  for (unsigned int cell = 0; cell < factors.size(); ++cell)
  {
    const double squared = estimate.cell_discretization[cell];
    if (estimate.is_any_contact_unseen ? estimate.is_contact_unseen[cell] : errors.is_large(squared))
      factors[cell] = 0.5;
    else if (!estimate.is_any_contact_unseen && errors.is_small(squared))
      factors[cell] = 2.;
  }
  return factors;
}

/// Edge lengths wanted at the nodes: the mean over their cells, by volume [m]. One value a degree of freedom.
template <int dim>
Vector find_nodal_sizes(const std::vector<double> &factors, const Discretization<dim> &discretization)
{
  const CellTable<dim> &cells = discretization.cells;
  Vector sizes = discretization.make_vector(), volumes = discretization.make_vector();
  for (unsigned int cell = discretization.tetrahedra->first_cell; cell < cells.n_cells; ++cell)
  {
    const double wanted = factors[cell] * size_of_cell(cells, cell);
    for (unsigned int i = 0; i < cells.n_cell_dofs(cell); ++i)
    {
      const double volume = cells.cell_nodal_measures(cell)[i / dim];
      sizes.local_element(cells.cell_dofs(cell)[i]) += volume * wanted;
      volumes.local_element(cells.cell_dofs(cell)[i]) += volume;
    }
  }
  sizes.compress(dealii::VectorOperation::add);
  volumes.compress(dealii::VectorOperation::add);
  for (unsigned int i = 0; i < sizes.locally_owned_size(); ++i)
    if (volumes.local_element(i) > 0.)
      sizes.local_element(i) /= volumes.local_element(i);
  sizes.update_ghost_values();
  return sizes;
}

/// Smallest and largest size of all ranks.
template <int dim>
std::pair<double, double> find_range(const Vector &sizes, const Discretization<dim> &discretization)
{
  double smallest = std::numeric_limits<double>::max(), largest = 0.;
  for (unsigned int i = 0; i < sizes.locally_owned_size(); ++i)
    if (sizes.local_element(i) > 0.)
    {
      smallest = std::min(smallest, sizes.local_element(i));
      largest = std::max(largest, sizes.local_element(i));
    }
  return {dealii::Utilities::MPI::min(smallest, discretization.communicator()),
          dealii::Utilities::MPI::max(largest, discretization.communicator())};
}
} // namespace

template <int dim>
std::vector<PlacedSimplexMesh>
make_adapted_meshes(const ErrorEstimate &estimate, const AdaptivityParameters &adaptivity,
                    const std::vector<BodyParameters> &bodies, const Discretization<dim> &discretization)
{
  const Vector sizes = find_nodal_sizes(find_factors(estimate, adaptivity, discretization), discretization);
  const auto [smallest, largest] = find_range(sizes, discretization);
  const SimplexField<dim> field(discretization, {&sizes});
  const auto size_of_body = [&](unsigned int body)
  {
    const Placement<dim> placement(bodies[body].placement);
    return [&field, placement, body, scale = bodies[body].placement.scale,
            coarsest = coarsest_size(bodies[body].mesh, dim), smallest = smallest,
            largest = largest](const Triple &own)
    {
      const double wanted =
          std::clamp(field.evaluate(body, placement.place(to_point<dim>(own)))[0][0], smallest, largest);
      return std::min(wanted / scale, coarsest);
    };
  };
  return place_simplex_meshes<dim>(bodies, discretization.degree, discretization.communicator(),
                                   size_of_body);
}

template std::vector<PlacedSimplexMesh> make_adapted_meshes(const ErrorEstimate &,
                                                            const AdaptivityParameters &,
                                                            const std::vector<BodyParameters> &,
                                                            const Discretization<2> &);
template std::vector<PlacedSimplexMesh> make_adapted_meshes(const ErrorEstimate &,
                                                            const AdaptivityParameters &,
                                                            const std::vector<BodyParameters> &,
                                                            const Discretization<3> &);
} // namespace signorini
