// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/mesh/check_cells.h"

#include "signorini/base/exceptions.h"
#include "signorini/mesh/simplex_geometry.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace signorini
{
namespace
{
/// Relative to the cube of the longest edge. Round-off in coordinates of size |x| gives a flat cell a
/// determinant of about 1e-16·|x|/L: this is above it up to |x| = 1e4·L, and far below a cell that one could
/// calculate with.
constexpr double smallest_determinant = 1e-12;

/// Of two nodes, relative to the shortest edge of the mesh.
constexpr double smallest_distance = 1e-6;

constexpr double off_plane = 1e-9;

std::string describe(const Triple &point)
{
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", point[0], point[1], point[2]);
}

std::array<Triple, 4> corners_of(const FileMesh &mesh, const FileMesh::Cell &cell)
{
  std::array<Triple, 4> corners{};
  for (unsigned int v = 0; v < mesh.n_corners(); ++v)
    corners[v] = mesh.nodes[cell.nodes[v]];
  return corners;
}

Complaint complain(const FileMesh &mesh, const FileMesh::Cell &cell, const std::string &what)
{
  return Complaint(what).at(mesh.file + ", " + describe_cell(mesh, cell));
}

double longest_edge(const std::array<Triple, 4> &corners, const unsigned int dimension)
{
  double longest = 0.;
  for (unsigned int e = 0; e < (dimension == 3 ? 6 : 3); ++e)
    longest = std::max(longest, distance(corners[edges_of_cell[e][0]], corners[edges_of_cell[e][1]]));
  return longest;
}

double shortest_edge(const FileMesh &mesh)
{
  double shortest = std::numeric_limits<double>::max();
  for (const FileMesh::Cell &cell : mesh.cells)
    for (unsigned int e = 0; e < (mesh.dimension == 3 ? 6 : 3); ++e)
      if (const double edge = distance(mesh.nodes[cell.nodes[edges_of_cell[e][0]]],
                                       mesh.nodes[cell.nodes[edges_of_cell[e][1]]]);
          edge > 0.)
        shortest = std::min(shortest, edge);
  return shortest;
}

void check_coordinates(const FileMesh &mesh)
{
  double size = 0.;
  for (const FileMesh::Cell &cell : mesh.cells)
    for (unsigned int v = 0; v < cell.n_nodes; ++v)
      for (const double coordinate : mesh.nodes[cell.nodes[v]])
      {
        if (!std::isfinite(coordinate))
          throw InputError(complain(mesh, cell, "a node has a coordinate that is no finite number")
                               .found(describe(mesh.nodes[cell.nodes[v]]))
                               .advise("mend the mesh where it was made"));
        size = std::max(size, std::abs(coordinate));
      }
  if (mesh.dimension == 3)
    return;
  for (const FileMesh::Cell &cell : mesh.cells)
    for (unsigned int v = 0; v < cell.n_nodes; ++v)
      if (std::abs(mesh.nodes[cell.nodes[v]][2]) > off_plane * size)
        throw InputError(
            complain(mesh, cell, "the triangles do not lie in the plane z = 0")
                .found(describe(mesh.nodes[cell.nodes[v]]))
                .advise("set Dimension = 3 and give tetrahedra, or turn the mesh into the plane"));
}

void check_repeated_nodes(const FileMesh &mesh)
{
  for (const FileMesh::Cell &cell : mesh.cells)
    for (unsigned int v = 0; v < cell.n_nodes; ++v)
      for (unsigned int w = 0; w < v; ++w)
        if (cell.nodes[v] == cell.nodes[w])
          throw InputError(complain(mesh, cell, "a cell has the same node twice")
                               .found(fmt::format("its nodes {} and {} are the one at {}", w + 1, v + 1,
                                                  describe(mesh.nodes[cell.nodes[v]])))
                               .expected("different nodes")
                               .advise("remove the cell or mend the mesh where it was made"));
}

/// Along a direction in which hardly any two nodes of a regular mesh agree.
void check_places(const FileMesh &mesh)
{
  const auto along = [](const Triple &x)
  { return x[0] + std::sqrt(2.) / 2. * x[1] + std::sqrt(3.) / 3. * x[2]; };
  const double tolerance = smallest_distance * shortest_edge(mesh);
  std::vector<std::pair<double, unsigned int>> order;
  for (unsigned int node = 0; node < mesh.nodes.size(); ++node)
    order.emplace_back(along(mesh.nodes[node]), node);
  std::sort(order.begin(), order.end());
  std::size_t n_pairs = 0;
  Triple place{};
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t j = i + 1; j < order.size() && order[j].first - order[i].first <= 2. * tolerance; ++j)
      if (distance(mesh.nodes[order[i].second], mesh.nodes[order[j].second]) <= tolerance)
      {
        place = mesh.nodes[order[i].second];
        ++n_pairs;
      }
  if (n_pairs > 0)
    throw InputError(
        Complaint("nodes lie at the same place: the cells on either side do not hang together")
            .at(mesh.file)
            .found(fmt::format("{} pair{}, for example at {}", n_pairs, n_pairs == 1 ? "" : "s",
                               describe(place)))
            .expected(fmt::format("nodes farther apart than {:.0e} of the shortest edge", smallest_distance))
            .advise(
                "merge equal nodes where the mesh was made (Gmsh: Coherence Mesh), or choose one of several "
                "touching parts with 'Regions'"));
}

void check_doubled(const FileMesh &mesh)
{
  std::vector<std::pair<std::array<unsigned int, 4>, unsigned int>> order;
  for (unsigned int c = 0; c < mesh.cells.size(); ++c)
  {
    std::array<unsigned int, 4> corners{};
    std::copy_n(mesh.cells[c].nodes.begin(), mesh.n_corners(), corners.begin());
    std::sort(corners.begin(), corners.end());
    order.emplace_back(corners, c);
  }
  std::sort(order.begin(), order.end());
  for (std::size_t i = 1; i < order.size(); ++i)
    if (order[i].first == order[i - 1].first)
      throw InputError(
          complain(mesh, mesh.cells[order[i].second], "the same cell stands in the file twice")
              .found(fmt::format("cells {} and {} have the same corners",
                                 mesh.cells[order[i - 1].second].number, mesh.cells[order[i].second].number))
              .advise("remove one of them"));
}

/// Determinants of all cells; throws for one without volume.
std::vector<double> compute_determinants(const FileMesh &mesh)
{
  std::vector<double> determinants;
  for (const FileMesh::Cell &cell : mesh.cells)
  {
    const std::array<Triple, 4> corners = corners_of(mesh, cell);
    const double scale = std::pow(longest_edge(corners, mesh.dimension), mesh.dimension);
    determinants.push_back(determinant(corners, mesh.dimension));
    if (!(std::abs(determinants.back()) > smallest_determinant * scale))
      throw InputError(
          complain(mesh, cell, mesh.dimension == 3 ? "a cell has no volume" : "a cell has no area")
              .found(fmt::format("determinant {:.3g}, longest edge {:.6g}", determinants.back(),
                                 longest_edge(corners, mesh.dimension)))
              .expected(fmt::format("more than {:.0e} of the longest edge to the power {}",
                                    smallest_determinant, mesh.dimension))
              .advise("improve the mesh where it was made"));
  }
  return determinants;
}

/// Exchanges the first two corners, and with them the middle nodes of edges.
void turn(FileMesh::Cell &cell, const unsigned int dimension)
{
  std::swap(cell.nodes[0], cell.nodes[1]);
  if (cell.n_nodes == dimension + 1)
    return;
  std::swap(cell.nodes[dimension + 2], cell.nodes[dimension + 3]);
  if (dimension == 3)
    std::swap(cell.nodes[7], cell.nodes[8]);
}

void check_orientation(FileMesh &mesh, const std::vector<double> &determinants)
{
  std::map<unsigned int, std::pair<std::size_t, std::size_t>> counts; // of each block: cells, inverted ones
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
  {
    auto &[n_cells, n_inverted] = counts[mesh.cells[c].block];
    ++n_cells;
    n_inverted += determinants[c] < 0. ? 1 : 0;
  }
  for (std::size_t c = 0; c < mesh.cells.size(); ++c)
    if (const auto [n_cells, n_inverted] = counts[mesh.cells[c].block]; determinants[c] < 0.)
    {
      if (n_inverted < n_cells)
        throw InputError(
            complain(mesh, mesh.cells[c], "a cell is inverted")
                .found(fmt::format("{} inverted among {} cells, this one with determinant {:.3g}", n_inverted,
                                   n_cells, determinants[c]))
                .expected("positive volume with the nodes in their order (or negative of all cells: then all "
                          "are turned)")
                .advise("mend the mesh where it was made"));
      turn(mesh.cells[c], mesh.dimension);
    }
}

void check_folds(const FileMesh &mesh)
{
  for (const FileMesh::Cell &cell : mesh.cells)
    if (cell.n_nodes > mesh.n_corners())
    {
      QuadraticCell nodes{};
      for (unsigned int v = 0; v < cell.n_nodes; ++v)
        nodes[v] = mesh.nodes[cell.nodes[v]];
      if (const double least = least_relative_jacobian(nodes, mesh.dimension); !(least > 0.))
        throw InputError(
            complain(mesh, cell, "a quadratic cell is folded by its curved edges")
                .found(fmt::format("least Jacobian at its nodes {:.3g} of that of the straight cell", least))
                .expected("> 0")
                .advise("optimise the mesh where it was made (Gmsh: Mesh.HighOrderOptimize), make it "
                        "finer, or write linear cells"));
    }
}
} // namespace

std::string describe_cell(const FileMesh &mesh, const FileMesh::Cell &cell)
{
  Triple centre{};
  for (unsigned int v = 0; v < mesh.n_corners(); ++v)
    for (unsigned int c = 0; c < 3; ++c)
      centre[c] += mesh.nodes[cell.nodes[v]][c] / mesh.n_corners();
  return fmt::format("cell {} at {}", cell.number, describe(centre));
}

void check_cells(FileMesh &mesh)
{
  check_coordinates(mesh);
  check_repeated_nodes(mesh);
  check_places(mesh);
  check_doubled(mesh);
  check_orientation(mesh, compute_determinants(mesh));
  check_folds(mesh);
}
} // namespace signorini
