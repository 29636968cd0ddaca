// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/output/displacement_error.h"

#include "signorini/base/spatial_vector.h"
#include "signorini/base/to_point.h"
#include "signorini/parameters/expression.h"

#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/fe_values_extractors.h>

#include <cmath>

namespace signorini
{
namespace
{
template <int dim>
class ExactDisplacement
{
public:
  ExactDisplacement(const std::vector<std::string> &formulas, double time) : t(time)
  {
    for (const std::string &formula : formulas)
      components.emplace_back(formula);
  }

  dealii::Tensor<1, dim> value(const dealii::Point<dim> &x) const
  {
    dealii::Tensor<1, dim> u;
    for (unsigned int d = 0; d < dim; ++d)
      u[d] = components[d].value(to_triple<dim>(x), t);
    return u;
  }

  /// `length`: over which the solution varies little.
  dealii::Tensor<2, dim> gradient(const dealii::Point<dim> &x, double length) const
  {
    const double step = 1e-3 * length; // error about 1e-7 of the gradient's variation
    dealii::Tensor<2, dim> gradient;
    for (unsigned int d = 0; d < dim; ++d)
    {
      dealii::Point<dim> ahead = x, behind = x;
      ahead[d] += step;
      behind[d] -= step;
      const dealii::Tensor<1, dim> slope = (value(ahead) - value(behind)) / (2. * step);
      for (unsigned int i = 0; i < dim; ++i)
        gradient[i][d] = slope[i];
    }
    return gradient;
  }

private:
  std::vector<Expression> components;
  double t;
};

/// ε : C : ε [J/m³].
template <int dim>
double twice_energy_density(const dealii::Tensor<2, dim> &gradient, const MaterialParameters &material)
{
  const double E = material.youngs_modulus, nu = material.poissons_ratio;
  const double mu = E / (2. * (1. + nu)), lambda = E * nu / ((1. + nu) * (1. - 2. * nu));
  const dealii::SymmetricTensor<2, dim> strain = symmetrize(gradient);
  return 2. * mu * (strain * strain) + lambda * trace(strain) * trace(strain);
}

/// Adds the squares of a DisplacementError's four numbers over the own cells of one part.
template <int dim>
void add_squares(const MeshPart<dim> &part, const std::vector<MaterialParameters> &materials,
                 const Vector &displacement, const ExactDisplacement<dim> &exact, std::vector<double> &sums)
{
  const dealii::Quadrature<dim> quadrature = part.gauss_rule(part.element.degree + 2);
  dealii::FEValues<dim> values(part.mapping(), part.element, quadrature,
                               dealii::update_values | dealii::update_gradients | dealii::update_JxW_values |
                                   dealii::update_quadrature_points);
  const dealii::FEValuesExtractors::Vector components(0);
  std::vector<dealii::Tensor<1, dim>> u(quadrature.size());
  std::vector<dealii::Tensor<2, dim>> gradients(quadrature.size());
  for (const auto &cell : part.own_cells())
  {
    values.reinit(cell);
    values[components].get_function_values(displacement, u);
    values[components].get_function_gradients(displacement, gradients);
    const MaterialParameters &material = materials[cell->material_id()];
    for (unsigned int q = 0; q < quadrature.size(); ++q)
    {
      const dealii::Point<dim> &x = values.quadrature_point(q);
      const dealii::Tensor<1, dim> exact_u = exact.value(x);
      const dealii::Tensor<2, dim> exact_gradient = exact.gradient(x, cell->diameter());
      const std::array<double, 4> terms{{(u[q] - exact_u).norm_square(), exact_u.norm_square(),
                                         twice_energy_density(gradients[q] - exact_gradient, material),
                                         twice_energy_density(exact_gradient, material)}};
      for (unsigned int i = 0; i < 4; ++i)
        sums[i] += values.JxW(q) * terms[i];
    }
  }
}
} // namespace

template <int dim>
DisplacementError measure_displacement_error(const Discretization<dim> &discretization,
                                             const std::vector<MaterialParameters> &materials,
                                             const Vector &displacement,
                                             const std::vector<std::string> &formulas, double t)
{
  const ExactDisplacement<dim> exact(formulas, t);
  std::vector<double> sums(4, 0.);
  for (const MeshPart<dim> *part : discretization.parts)
    add_squares(*part, materials, part->extract(displacement), exact, sums);
  dealii::Utilities::MPI::sum(sums, discretization.communicator(), sums);
  return {std::sqrt(sums[0]), std::sqrt(sums[1]), std::sqrt(sums[2]), std::sqrt(sums[3])};
}

template DisplacementError measure_displacement_error(const Discretization<2> &,
                                                      const std::vector<MaterialParameters> &, const Vector &,
                                                      const std::vector<std::string> &, double);
template DisplacementError measure_displacement_error(const Discretization<3> &,
                                                      const std::vector<MaterialParameters> &, const Vector &,
                                                      const std::vector<std::string> &, double);
} // namespace signorini
