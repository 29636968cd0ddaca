// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "potential_scene.h"
#include "volume_scene.h"

#include <gtest/gtest.h>

#include <sstream>
#include <variant>

namespace signorini::test
{
template <int dim, typename... Options>
auto make_scene(const Case &c, Options... options)
{
  return PotentialScene<dim>(c, options...);
}

template <int dim, typename... Options>
auto make_scene(const VolumeCase &c, Options... options)
{
  return VolumeScene<dim>(c, options...);
}

template <typename AnyCase, typename Check, typename... Options>
void check_scene(const AnyCase &c, const Check &check, Options... options)
{
  if (c.dim == 2)
    check(make_scene<2>(c, options...), std::integral_constant<int, 2>());
  else
    check(make_scene<3>(c, options...), std::integral_constant<int, 3>());
}

/// Laws of all potentials, each checked on every scene of every potential.
class ContactLaws : public testing::TestWithParam<std::variant<Case, VolumeCase>>
{
protected:
  template <typename Check, typename... Options>
  void on_scene(const Check &check, Options... options) const
  {
    std::visit([&](const auto &c) { check_scene(c, check, options...); }, GetParam());
  }
};

/// Laws of what only the surface potential has, on all its scenes.
class SurfaceLaws : public testing::TestWithParam<Case>
{
protected:
  template <typename Check>
  void on_scene(const Check &check) const
  {
    check_scene(GetParam(), check);
  }
};

/// Scenes whose points stay, of both dimensions, degrees and all kinds of targets and faces.
inline std::vector<Case> make_cases_of_points()
{
  std::vector<Case> cases;
  for (int dim : {2, 3})
    for (unsigned int degree : {1, 2})
      for (Target target : {Target::body, Target::itself, Target::plane, Target::sphere})
        cases.push_back({dim, degree, target, contact::Integration::face_quadrature});
  for (Triangles triangles : {Triangles::both, Triangles::upper, Triangles::lower})
    for (unsigned int degree : {1, 2})
      cases.push_back(
          {3, degree, Target::body, contact::Integration::face_quadrature, Multipliers::none, triangles});
  return cases;
}

/// Laws of implicit steps.
class StepLaws : public SurfaceLaws
{
};

struct NameCase
{
  std::string operator()(const testing::TestParamInfo<Case> &info) const { return name(info.param); }
  std::string operator()(const testing::TestParamInfo<ContactLaws::ParamType> &info) const
  {
    return std::visit([](const auto &c) { return name(c); }, info.param);
  }

  template <typename AnyCase>
  static std::string name(const AnyCase &c)
  {
    std::ostringstream stream;
    stream << c;
    return stream.str();
  }
};

/// Where the nodes of a scene were before a step: they slid, sank and bent in it.
template <typename Scene>
auto make_start(const Scene &scene)
{
  constexpr int dim = std::decay_t<decltype(scene.positions[0])>::RowsAtCompileTime;
  SpatialVector<dim> way = .02 * SpatialVector<dim>::Unit(dim - 1);
  way[0] = .03;
  RandomVectors<dim> random(11);
  return shifted<dim>(scene.moved(way), random.field(scene.positions.size(), 5e-3), 1.);
}

/// What the tangent of `friction` makes of the forces of nodes that move by these vectors.
template <int dim, typename Friction>
Positions<dim> apply_tangent(const Friction &friction, const Positions<dim> &way)
{
  Positions<dim> change(way.size(), SpatialVector<dim>::Zero());
  friction.for_each_tangent(
      [&](const std::vector<unsigned int> &nodes, const Eigen::MatrixXd &block)
      {
        for (std::size_t a = 0; a < nodes.size(); ++a)
          for (std::size_t b = 0; b < nodes.size(); ++b)
            change[nodes[a]] -= block.block<dim, dim>(dim * a, dim * b) * way[nodes[b]];
      });
  return change;
}

/// Sum of the forces, and of their moments about the origin (entries of the skew part of Σ x fᵀ).
template <int dim>
double measure_imbalance(const Positions<dim> &x, const Positions<dim> &forces)
{
  SpatialVector<dim> sum = SpatialVector<dim>::Zero();
  SpatialTensor<dim> moment = SpatialTensor<dim>::Zero();
  for (std::size_t i = 0; i < x.size(); ++i)
  {
    sum += forces[i];
    moment += x[i] * forces[i].transpose();
  }
  return sum.norm() + (moment - moment.transpose()).norm();
}
} // namespace signorini::test
