// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/simulation/size_estimate.h"

#include "signorini/base/exceptions.h"
#include "signorini/discretization/generated_simplex_mesh.h"
#include "signorini/parameters/body_parameters.h"

#include <deal.II/base/mpi.h>

#include <fmt/core.h>

#include <unistd.h>

#include <algorithm>
#include <cmath>

namespace signorini
{
namespace
{
double extent_of_surface(const SimplexMesh &surface, unsigned int direction)
{
  const auto [least, greatest] = std::minmax_element(surface.vertices.begin(), surface.vertices.end(),
                                                     [direction](const Triple &a, const Triple &b)
                                                     { return a[direction] < b[direction]; });
  return (*greatest)[direction] - (*least)[direction];
}

/// Volume (area in 2-D) before placement, of a ball or cylinder that of the cube around it, of a file that of
/// the box.
double rough_volume(const MeshParameters &mesh, unsigned int dimension)
{
  if (mesh.shape == MeshParameters::Shape::cylinder)
    return 4. * mesh.radius * mesh.radius * mesh.length;
  double volume = 1.;
  for (unsigned int d = 0; d < dimension; ++d)
  {
    const bool is_halved = mesh.part == MeshParameters::Part::orthant ||
                           (mesh.part == MeshParameters::Part::half && d + 1 == dimension);
    if (mesh.shape == MeshParameters::Shape::box)
      volume *= mesh.upper_corner[d] - mesh.lower_corner[d];
    else if (mesh.shape == MeshParameters::Shape::ball)
      volume *= (is_halved ? 1. : 2.) * mesh.radius;
    else
      volume *= extent_of_surface(*mesh.surface_of_file, d);
  }
  return volume;
}

/// Cells before refinements and grading.
double n_coarse_cells(const MeshParameters &mesh, unsigned int dimension)
{
  const bool is_solid = dimension == 3;
  if (mesh.mesh_of_file)
    return static_cast<double>(mesh.mesh_of_file->cells.size());
  if (mesh.cell_type == MeshParameters::CellType::tetrahedra && mesh.element_size > 0.)
    return n_cells_of_cube(dimension) * rough_volume(mesh, dimension) /
           std::pow(mesh.element_size, dimension);
  if (mesh.shape == MeshParameters::Shape::cylinder)
    return 10.;
  if (mesh.shape == MeshParameters::Shape::box)
  {
    const double n_blocks =
        static_cast<double>(mesh.cells[0]) * mesh.cells[1] * (is_solid ? mesh.cells[2] : 1.);
    const bool is_cut = mesh.cell_type == MeshParameters::CellType::tetrahedra;
    return n_blocks * (is_cut ? (is_solid ? 6. : 2.) : 1.);
  }
  switch (mesh.part)
  {
  case MeshParameters::Part::whole:
    return is_solid ? 7. : 5.;
  case MeshParameters::Part::half:
    return is_solid ? 6. : 4.;
  default:
    return is_solid ? 4. : 3.;
  }
}

/// Every level of a grading splits the cells within its distance of a corner, or of one face.
double estimate_cells(const MeshParameters &mesh, unsigned int dimension)
{
  double n_cells = n_coarse_cells(mesh, dimension) * std::pow(2., dimension * mesh.refinements);
  if (!mesh.grading)
    return n_cells;
  const double volume = rough_volume(mesh, dimension);
  double cell_volume = volume / n_cells;
  for (unsigned int level = 1; level <= mesh.grading->levels; ++level)
  {
    const double distance = mesh.grading->distance * std::pow(2., mesh.grading->levels - level);
    const double region = mesh.grading->boundary ? distance * std::pow(volume, 1. - 1. / dimension)
                                                 : 0.5 * std::pow(distance, dimension);
    const double n_split = std::max(1., std::min(region, volume) / cell_volume);
    n_cells += n_split * (std::pow(2., dimension) - 1.);
    cell_volume /= std::pow(2., dimension);
  }
  return n_cells;
}

/// Of a single body, which shares no node with others.
double estimate_nodes(const MeshParameters &mesh, double n_cells, unsigned int dimension, unsigned int degree)
{
  if (mesh.cell_type == MeshParameters::CellType::hexahedra)
    return std::pow(std::pow(n_cells, 1. / dimension) * degree + 1., dimension);
  if (dimension == 3)
    return n_cells * (degree == 1 ? 0.2 : 1.45);
  return n_cells * (degree == 1 ? 0.5 : 2.);
}

/// Simplices that the volume potential makes of a cell.
double n_simplices_of_cell(const MeshParameters &mesh, unsigned int dimension)
{
  if (mesh.cell_type == MeshParameters::CellType::tetrahedra)
    return 1.;
  return dimension == 3 ? 24. : 4.;
}

/// Of the rule for the elastic energy.
double n_points_of_cell(const MeshParameters &mesh, unsigned int dimension, unsigned int degree)
{
  if (mesh.cell_type == MeshParameters::CellType::tetrahedra)
    return degree == 1 ? 1. : dimension + 1.;
  return std::pow(degree + 1., dimension);
}

bool is_by_volumes(const Parameters &parameters)
{
  return parameters.contact && parameters.contact->potential == ContactParameters::Potential::volume &&
         parameters.bodies.size() > 1;
}

/// That of the machines on which the ranks run, each counted once [bytes].
double available_memory(const MPI_Comm &communicator)
{
  MPI_Comm machine = MPI_COMM_NULL;
  MPI_Comm_split_type(communicator, MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &machine);
  const bool is_first = dealii::Utilities::MPI::this_mpi_process(machine) == 0;
  MPI_Comm_free(&machine);
  const double own = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * sysconf(_SC_PAGE_SIZE);
  return dealii::Utilities::MPI::sum(is_first ? own : 0., communicator);
}
} // namespace

SizeEstimate estimate_size(const Parameters &parameters, unsigned int n_ranks)
{
  // Measured: a program without cells, a coarse cell on every rank, a cell beside its points, a degree of
  // freedom, a simplex of the volume potential on every rank. Points keep inverse Jacobians and weights, once
  // more for the kernels. A matrix entry takes 16 bytes; its preconditioner or factors at least as much as
  // two further matrices. Explicit runs of 64 000 and 384 000 cells take 0.9 to 1.25 times as much.
  constexpr double bytes_of_program = 1.5e8, bytes_of_coarse_cell = 1e3, bytes_of_cell = 1.1e3,
                   bytes_of_dof = 170., bytes_of_simplex = 300., bytes_of_entry = 3. * 16.;
  const unsigned int dim = parameters.dimension, degree = parameters.degree;
  const double bytes_of_point = 2. * sizeof(double) * (dim * dim + 1.);
  SizeEstimate size;
  double n_coarse = 0., n_simplices = 0., n_points = 0., most_cells = 0.;
  for (const BodyParameters &body : parameters.bodies)
  {
    const double n_cells = estimate_cells(body.mesh, dim);
    if (n_cells > most_cells)
      size.largest = &body;
    most_cells = std::max(most_cells, n_cells);
    n_coarse += n_coarse_cells(body.mesh, dim);
    size.n_cells += n_cells;
    n_points += n_cells * n_points_of_cell(body.mesh, dim, degree);
    n_simplices += is_by_volumes(parameters) ? n_cells * n_simplices_of_cell(body.mesh, dim) : 0.;
    size.n_dofs += dim * estimate_nodes(body.mesh, n_cells, dim, degree);
  }
  size.memory =
      n_ranks * (bytes_of_program + bytes_of_coarse_cell * n_coarse + bytes_of_simplex * n_simplices) +
      size.n_cells * bytes_of_cell + n_points * bytes_of_point + size.n_dofs * bytes_of_dof;
  if (std::holds_alternative<QuasiStaticParameters>(parameters.solver))
    size.memory += size.n_dofs * dim * std::pow(degree + 2., dim) * bytes_of_entry;
  return size;
}

void check_size(const ParameterText &text, const Parameters &parameters, const MPI_Comm &communicator)
{
  const SizeEstimate size = estimate_size(parameters, dealii::Utilities::MPI::n_mpi_processes(communicator));
  const double available = available_memory(communicator);
  if (size.memory <= available)
    return;
  constexpr double gigabyte = 1e9;
  throw InputError(
      Complaint("the meshes are too large for the memory of this machine")
          .at(text.where(body_subsection(size.largest->name) + "/Mesh"))
          .found(
              fmt::format("about {:.3g} cells and {:.3g} degrees of freedom, which take at least {:.3g} GB",
                          size.n_cells, size.n_dofs, size.memory / gigabyte))
          .expected(fmt::format("{:.3g} GB on all ranks together", available / gigabyte))
          .advise(fmt::format(
              "{} Refinements or Grading/Levels of body '{}', which has the most cells, or Degree",
              size.largest->mesh.cell_type == MeshParameters::CellType::hexahedra
                  ? "lower Cells,"
                  : "raise Element size, or lower",
              size.largest->name)));
}
} // namespace signorini
