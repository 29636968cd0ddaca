// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/contact/geometry/facet_shape.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>
#include <random>

namespace signorini::test
{
template <int dim>
using Positions = std::vector<SpatialVector<dim>>;

/// Which bodies may touch, in scenes without self-contact.
inline bool different_bodies(unsigned int body, unsigned int other)
{
  return body != other;
}

/// A box of n × n (× n) elements and its material, as seen from outside; every side of an element is one
/// quadrilateral or two triangles.
template <int dim>
struct BoxBody
{
  SpatialVector<dim> corner = SpatialVector<dim>::Zero();
  SpatialVector<dim> size = SpatialVector<dim>::Ones();
  unsigned int n_faces = 2; ///< along every edge
  unsigned int degree = 1;
  FacetType type = FacetType::tensor_product;
  double youngs_modulus = 1e3;
  double density = 10.;
};

/// Grows a surface box by box; nodes are shared by the faces of one box.
template <int dim>
class BoxSurfaceBuilder
{
public:
  ContactSurface<dim> surface;

  void add(const BoxBody<dim> &box)
  {
    nodes.clear();
    for (unsigned int axis = 0; axis < dim; ++axis)
      for (unsigned int side = 0; side < 2; ++side)
        add_side(box, axis, side);
    ++surface.n_bodies;
  }

private:
  using Lattice = std::array<unsigned int, dim>;
  std::map<Lattice, unsigned int> nodes;

  unsigned int node_at(const BoxBody<dim> &box, const Lattice &lattice)
  {
    const auto [entry, is_new] = nodes.emplace(lattice, surface.n_nodes());
    if (is_new)
    {
      SpatialVector<dim> x = box.corner;
      for (unsigned int i = 0; i < dim; ++i)
        x[i] += box.size[i] * lattice[i] / (box.n_faces * box.degree);
      surface.reference_positions.push_back(x);
    }
    return entry->second;
  }

  void add_side(const BoxBody<dim> &box, unsigned int axis, unsigned int side)
  {
    for (unsigned int j = 0; j < (dim == 3 ? box.n_faces : 1); ++j)
      for (unsigned int i = 0; i < box.n_faces; ++i)
        for (unsigned int half = 0; half < (box.type == FacetType::triangle ? 2 : 1); ++half)
          add_facet(box, axis, side, {i, j, half});
  }

  struct Place
  {
    unsigned int column, row, half;
  };

  void add_facet(const BoxBody<dim> &box, unsigned int axis, unsigned int side, const Place &place)
  {
    const unsigned int p = box.degree;
    Facet<dim> facet;
    facet.degree = p;
    facet.type = box.type;
    facet.body = surface.n_bodies;
    facet.layer_thickness = box.size[axis] / box.n_faces;
    facet.room = (box.n_faces == 1 ? .5 : 1.) * facet.layer_thickness;
    facet.youngs_modulus = box.youngs_modulus;
    facet.density = box.density;
    const bool reversed = dim == 2 ? (axis == 0) != (side == 1) : side == 0;
    for (unsigned int a = 0; a < facet.n_nodes(); ++a)
    {
      const LocalPoint<dim> xi = contact::node_coordinates(facet, a);
      std::array<unsigned int, 2> steps{{0, 0}};
      for (unsigned int d = 0; d < dim - 1; ++d)
        steps[d] = static_cast<unsigned int>(std::lround(p * (place.half == 0 ? xi[d] : 1. - xi[d])));
      if (reversed)
      {
        if (dim == 2)
          steps[0] = p - steps[0];
        else
          std::swap(steps[0], steps[1]);
      }
      Lattice lattice;
      lattice[axis] = side * box.n_faces * p;
      lattice[(axis + 1) % dim] = place.column * p + steps[0];
      if (dim == 3)
        lattice[(axis + 2) % dim] = place.row * p + steps[1];
      facet.nodes[a] = node_at(box, lattice);
    }
    surface.facets.push_back(facet);
  }
};

/// Random vectors, the same ones at every run.
template <int dim>
class RandomVectors
{
public:
  explicit RandomVectors(unsigned int seed) : engine(seed) {}

  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }

  SpatialVector<dim> vector(double size)
  {
    SpatialVector<dim> v;
    for (unsigned int i = 0; i < dim; ++i)
      v[i] = number(-size, size);
    return v;
  }

  Positions<dim> field(std::size_t n, double size)
  {
    Positions<dim> v(n);
    for (auto &entry : v)
      entry = vector(size);
    return v;
  }

  SpatialTensor<dim> rotation()
  {
    if constexpr (dim == 2)
      return Eigen::Rotation2Dd(number(-3., 3.)).toRotationMatrix();
    else
      return Eigen::AngleAxisd(number(-3., 3.), vector(1.).normalized()).toRotationMatrix();
  }

private:
  std::mt19937 engine;
};

/// `x` + `factor` `direction`
template <int dim>
Positions<dim> shifted(const Positions<dim> &x, const Positions<dim> &direction, double factor)
{
  Positions<dim> result(x);
  for (std::size_t i = 0; i < x.size(); ++i)
    result[i] += factor * direction[i];
  return result;
}

/// The closed path x + cos θ `first` + sin θ `second`.
template <int dim>
struct Loop
{
  Positions<dim> first, second;
};
} // namespace signorini::test
