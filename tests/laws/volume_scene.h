// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/potential/volume_potential.h"

#include "box_surface.h"

#include <numeric>
#include <ostream>

namespace signorini::test
{
enum class Cells
{
  simplices, ///< every cube cut along its diagonal
  split      ///< every cube cut through its centre and those of its faces
};

struct VolumeCase
{
  int dim;
  Cells cells;
};

inline std::ostream &operator<<(std::ostream &out, const VolumeCase &c)
{
  return out << "VolumeDim" << c.dim << (c.cells == Cells::simplices ? "Simplices" : "SplitCells");
}

/// Boxes of n_faces cells along each edge, each a body.
template <int dim>
class BoxVolumeBuilder
{
public:
  ContactVolume<dim> volume;

  BoxVolumeBuilder(const std::vector<BoxBody<dim>> &boxes, Cells cells)
  {
    std::vector<unsigned int> first_nodes;
    for (const auto &box : boxes)
    {
      first_nodes.push_back(volume.n_nodes());
      add_nodes(box);
    }
    for (const auto &box : boxes)
    {
      Simplex<dim> simplex;
      simplex.body = volume.n_bodies++;
      simplex.youngs_modulus = box.youngs_modulus;
      simplex.density = box.density;
      CellSplitter<dim> splitter(volume);
      for (const auto &cell : make_cells(box.n_faces, first_nodes[simplex.body]))
        if (cells == Cells::split)
          splitter.add(cell, simplex);
        else
          add_simplices_along_diagonal(cell, simplex);
    }
    compute_heights(volume);
  }

private:
  using Cell = typename CellSplitter<dim>::Cell;

  static unsigned int power(unsigned int base, unsigned int exponent)
  {
    return exponent == 0 ? 1 : base * power(base, exponent - 1);
  }

  void add_nodes(const BoxBody<dim> &box)
  {
    const unsigned int n = box.n_faces + 1;
    for (unsigned int i = 0; i < power(n, dim); ++i)
    {
      SpatialVector<dim> x = box.corner;
      for (unsigned int axis = 0; axis < dim; ++axis)
        x[axis] += box.size[axis] * (i / power(n, axis) % n) / box.n_faces;
      volume.reference_positions.push_back(x);
    }
  }

  static std::vector<Cell> make_cells(unsigned int n, unsigned int first_node)
  {
    std::vector<Cell> cells(power(n, dim));
    for (unsigned int i = 0; i < cells.size(); ++i)
      for (unsigned int corner = 0; corner < cells[i].size(); ++corner)
      {
        cells[i][corner] = first_node;
        for (unsigned int axis = 0; axis < dim; ++axis)
          cells[i][corner] += (i / power(n, axis) % n + (corner >> axis & 1)) * power(n + 1, axis);
      }
    return cells;
  }

  /// One for every order of the axes, along which its vertices go from corner to corner.
  void add_simplices_along_diagonal(const Cell &cell, Simplex<dim> simplex)
  {
    std::array<unsigned int, dim> axes;
    std::iota(axes.begin(), axes.end(), 0u);
    do
    {
      unsigned int corner = 0;
      simplex.vertices[0] = cell[0];
      for (unsigned int a = 0; a < dim; ++a)
      {
        corner += 1u << axes[a];
        simplex.vertices[a + 1] = cell[corner];
      }
      volume.simplices.push_back(simplex);
    } while (std::next_permutation(axes.begin(), axes.end()));
  }
};

/// A bent box pressed a little into another bent box of other mesh and material.
template <int dim>
struct VolumeScene
{
  static constexpr double overlap = .06;
  static constexpr double reach = 0.; ///< pairs farther apart than this need not be known

  /// The largest eigenvalue over its bound, at least: that one holds for any overlap within a skin, where
  /// this one is so deep that much of the force has turned round. tests/unit/contact/volume_potential.cc has
  /// more.
  static constexpr double sharpness = 1e-3;

  ContactVolume<dim> volume;
  Positions<dim> positions;
  contact::VolumePotentialSettings settings;
  unsigned int first_moving_node;

  explicit VolumeScene(const VolumeCase &c, unsigned int n_faces = 2, double bend = .02)
  {
    BoxBody<dim> lower;
    lower.n_faces = n_faces;
    BoxBody<dim> upper = lower;
    upper.size *= .75;
    upper.corner = SpatialVector<dim>::Constant(.1371);
    upper.corner[dim - 1] = 1. - overlap;
    upper.youngs_modulus = 3e3;
    volume = BoxVolumeBuilder<dim>({lower, upper}, c.cells).volume;
    first_moving_node = volume.n_nodes() / 2;
    RandomVectors<dim> random(5);
    positions = shifted<dim>(volume.reference_positions, random.field(volume.n_nodes(), bend), 1.);
  }

  void move(const SpatialTensor<dim> &rotation, const SpatialVector<dim> &shift)
  {
    for (auto &x : positions)
      x = rotation * x + shift;
  }

  contact::VolumePotential<dim> make_potential() const { return {volume, settings}; }

  /// Moves every node of the upper box by `shift`.
  Positions<dim> moved(const SpatialVector<dim> &shift) const
  {
    Positions<dim> x(positions);
    for (std::size_t i = first_moving_node; i < x.size(); ++i)
      x[i] += shift;
    return x;
  }

  Positions<dim> zeros() const { return Positions<dim>(positions.size(), SpatialVector<dim>::Zero()); }

  bool is_between_bodies() const { return true; }
  bool may_be_renewed() const { return true; }
  auto &parts() { return volume.simplices; }

  /// Leads the upper box round while both are deformed.
  Loop<dim> make_loop() const
  {
    RandomVectors<dim> random(6);
    const SpatialVector<dim> upwards = .05 * SpatialVector<dim>::Unit(dim - 1);
    const auto deform = [&](const SpatialVector<dim> &shift) {
      return shifted<dim>(shifted<dim>(moved(shift), positions, -1.), random.field(positions.size(), .04),
                          1.);
    };
    return {deform(.07 * SpatialVector<dim>::Unit(0)), deform(upwards)};
  }
};

template <int dim>
std::vector<double> bound_stiffness(const contact::VolumePotential<dim> &potential, std::size_t n_nodes)
{
  std::vector<double> stiffness(n_nodes, 0.);
  potential.add_row_sum_bounds(stiffness);
  return stiffness;
}
} // namespace signorini::test
