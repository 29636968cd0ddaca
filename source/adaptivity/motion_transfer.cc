// SPDX-License-Identifier: LGPL-2.1-or-later
#include "signorini/adaptivity/motion_transfer.h"

#include "signorini/physics/mass.h"

#include <Eigen/Dense>

namespace signorini
{
namespace
{
constexpr unsigned int n_modes = 6; ///< translations along the axes, then rotations about them

/// One body's velocity field of one mode at the position `arm` from the centre.
Eigen::Vector3d rigid_velocity(unsigned int mode, const Eigen::Vector3d &arm)
{
  return mode < 3 ? Eigen::Vector3d(Eigen::Vector3d::Unit(mode))
                  : Eigen::Vector3d(Eigen::Vector3d::Unit(mode - 3).cross(arm));
}

/// What supports of a body prescribe, and which of its momenta they therefore leave alone.
struct Freedom
{
  std::array<bool, 3> is_prescribed{};

  bool keeps(unsigned int mode, int dim) const
  {
    if (mode < 3)
      return static_cast<int>(mode) < dim && !is_prescribed[mode];
    const unsigned int axis = mode - 3;
    return (dim == 3 || axis == 2) && !is_prescribed[(axis + 1) % 3] && !is_prescribed[(axis + 2) % 3];
  }
};

template <int dim>
std::vector<Freedom> find_freedoms(const Scene<dim> &scene)
{
  std::vector<Freedom> freedoms(scene.n_bodies());
  for (const Support<dim> &support : scene.supports)
    freedoms[support.body].is_prescribed[support.component] = true;
  return freedoms;
}

template <int dim>
Eigen::Vector3d nodal_value(const OwnedNode<dim> &node, const Vector &values)
{
  Eigen::Vector3d value = Eigen::Vector3d::Zero();
  for (unsigned int d = 0; d < dim; ++d)
    value[d] = values.local_element(node.dofs[d]);
  return value;
}

template <int dim>
Eigen::Vector3d position_of(const OwnedNode<dim> &node)
{
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  for (unsigned int d = 0; d < dim; ++d)
    position[d] = node.position[d];
  return position;
}

/// Sums `n_terms` numbers a node over the nodes of each body and over all ranks: [body].
template <int n_terms, int dim, typename Terms>
std::vector<Eigen::Matrix<double, n_terms, 1>> sum_by_body(const Discretization<dim> &discretization,
                                                           unsigned int n_bodies, const Terms &terms)
{
  using Sum = Eigen::Matrix<double, n_terms, 1>;
  std::vector<double> sums(n_terms * n_bodies, 0.);
  for (const OwnedNode<dim> &node : discretization.owned_nodes)
    Eigen::Map<Sum>(&sums[n_terms * node.body]) += terms(node);
  dealii::Utilities::MPI::sum(sums, discretization.communicator(), sums);
  std::vector<Sum> by_body;
  for (unsigned int body = 0; body < n_bodies; ++body)
    by_body.push_back(Eigen::Map<const Sum>(&sums[n_terms * body]));
  return by_body;
}

/// The mean of a quantity over each body, by nodal weights.
template <int dim, typename Quantity>
std::vector<Eigen::Vector3d> means_by_body(const Discretization<dim> &discretization, unsigned int n_bodies,
                                           const Vector &weights, const Quantity &quantity)
{
  const auto sums = sum_by_body<4>(discretization, n_bodies,
                                   [&](const OwnedNode<dim> &node)
                                   {
                                     const double weight = weights.local_element(node.dofs[0]);
                                     Eigen::Vector4d terms;
                                     terms << weight, weight * quantity(node);
                                     return terms;
                                   });
  std::vector<Eigen::Vector3d> means;
  for (const Eigen::Vector4d &sum : sums)
    means.push_back(sum.tail<3>() / sum[0]);
  return means;
}

/// mean + gradient·(X − centre): the affine field nearest to a nodal one, component by component.
struct AffineField
{
  Eigen::Vector3d centre, mean;
  Eigen::Matrix3d gradient = Eigen::Matrix3d::Zero();

  Eigen::Vector3d value(const Eigen::Vector3d &position) const
  {
    return mean + gradient * (position - centre);
  }
};

template <int dim>
std::vector<AffineField> fit_affine_fields(const Discretization<dim> &discretization,
                                           const std::vector<Freedom> &freedoms, const Vector &values)
{
  const Vector volume = make_nodal_volume(discretization);
  const unsigned int n_bodies = freedoms.size();
  const auto centres = means_by_body(discretization, n_bodies, volume, position_of<dim>);
  const auto means = means_by_body(discretization, n_bodies, volume,
                                   [&](const OwnedNode<dim> &node) { return nodal_value(node, values); });
  const auto products = sum_by_body<18>(discretization, n_bodies,
                                        [&](const OwnedNode<dim> &node)
                                        {
                                          const double weight = volume.local_element(node.dofs[0]);
                                          const Eigen::Vector3d arm = position_of(node) - centres[node.body];
                                          Eigen::Matrix<double, 18, 1> terms;
                                          Eigen::Map<Eigen::Matrix3d>(terms.data()) =
                                              weight * arm * arm.transpose();
                                          Eigen::Map<Eigen::Matrix3d>(terms.data() + 9) =
                                              weight * nodal_value(node, values) * arm.transpose();
                                          return terms;
                                        });
  std::vector<AffineField> fields;
  for (unsigned int body = 0; body < n_bodies; ++body)
  {
    AffineField field{centres[body], means[body]};
    const Eigen::Matrix3d arms = Eigen::Map<const Eigen::Matrix3d>(products[body].data()),
                          with_values = Eigen::Map<const Eigen::Matrix3d>(products[body].data() + 9);
    field.gradient.topLeftCorner<dim, dim>() =
        with_values.topLeftCorner<dim, dim>() * arms.topLeftCorner<dim, dim>().inverse();
    for (unsigned int d = 0; d < 3; ++d)
      if (freedoms[body].is_prescribed[d])
      {
        field.mean[d] = 0.;
        field.gradient.row(d).setZero();
      }
    fields.push_back(field);
  }
  return fields;
}

template <int dim>
void add_affine_fields(const Discretization<dim> &discretization, const std::vector<AffineField> &fields,
                       double factor, Vector &values)
{
  for (const OwnedNode<dim> &node : discretization.owned_nodes)
  {
    const Eigen::Vector3d value = fields[node.body].value(position_of(node));
    for (unsigned int d = 0; d < dim; ++d)
      values.local_element(node.dofs[d]) += factor * value[d];
  }
  discretization.distribute(values);
}

using ByMode = Eigen::Matrix<double, n_modes, 1>;
using ModeProducts = Eigen::Matrix<double, n_modes, n_modes>;

/// Mass, momenta by mode, and the products of the modes in the mass, of one body.
using BodySums = Eigen::Matrix<double, 1 + n_modes + n_modes * n_modes, 1>;

ByMode momenta(const BodySums &sums)
{
  return sums.segment<n_modes>(1);
}

ModeProducts mode_products(const BodySums &sums)
{
  return Eigen::Map<const ModeProducts>(sums.data() + 1 + n_modes);
}

template <int dim>
std::vector<BodySums> measure(const Discretization<dim> &discretization, const Vector &mass,
                              const std::vector<Eigen::Vector3d> &centres, const State &state)
{
  return sum_by_body<BodySums::RowsAtCompileTime>(
      discretization, centres.size(),
      [&](const OwnedNode<dim> &node)
      {
        const double m = mass.local_element(node.dofs[0]);
        const Eigen::Vector3d v = nodal_value(node, state.velocity),
                              arm = position_of(node) + nodal_value(node, state.displacement) -
                                    centres[node.body];
        Eigen::Matrix<double, 3, n_modes> modes;
        for (unsigned int mode = 0; mode < n_modes; ++mode)
          modes.col(mode) = rigid_velocity(mode, arm);
        BodySums terms;
        terms[0] = m;
        terms.segment<n_modes>(1) = m * modes.transpose() * v;
        Eigen::Map<ModeProducts>(terms.data() + 1 + n_modes) = m * modes.transpose() * modes;
        return terms;
      });
}

/// The amplitudes of the modes that bring the momenta kept back by `missing`; zero for the others.
ByMode find_correction(const BodySums &sums, const Freedom &freedom, int dim, const ByMode &missing)
{
  std::vector<unsigned int> kept;
  for (unsigned int mode = 0; mode < n_modes; ++mode)
    if (freedom.keeps(mode, dim))
      kept.push_back(mode);
  const ModeProducts all_products = mode_products(sums);
  Eigen::MatrixXd products(kept.size(), kept.size());
  Eigen::VectorXd right_hand_side(kept.size());
  for (unsigned int i = 0; i < kept.size(); ++i)
  {
    right_hand_side[i] = missing[kept[i]];
    for (unsigned int j = 0; j < kept.size(); ++j)
      products(i, j) = all_products(kept[i], kept[j]);
  }
  ByMode amplitudes = ByMode::Zero();
  if (kept.empty())
    return amplitudes;
  const Eigen::VectorXd solution = products.ldlt().solve(right_hand_side);
  for (unsigned int i = 0; i < kept.size(); ++i)
    amplitudes[kept[i]] = solution[i];
  return amplitudes;
}

/// Adds what changed beyond the momenta kept, the moment about the origin.
void add_changes_by_supports(const ByMode &missing, const Freedom &freedom, int dim,
                             const Eigen::Vector3d &centre, VectorAndMoment &changes)
{
  Eigen::Vector3d linear = Eigen::Vector3d::Zero(), angular = linear;
  for (unsigned int mode = 0; mode < n_modes; ++mode)
    if (!freedom.keeps(mode, dim))
      (mode < 3 ? linear[mode] : angular[mode - 3]) = -missing[mode];
  angular += centre.cross(linear);
  for (unsigned int d = 0; d < 3; ++d)
  {
    changes.vector[d] += linear[d];
    changes.moment[d] += angular[d];
  }
}

template <int dim>
void add_rigid_velocities(const Discretization<dim> &discretization,
                          const std::vector<Eigen::Vector3d> &centres, const std::vector<ByMode> &amplitudes,
                          State &state)
{
  for (const OwnedNode<dim> &node : discretization.owned_nodes)
  {
    const Eigen::Vector3d arm =
        position_of(node) + nodal_value(node, state.displacement) - centres[node.body];
    for (unsigned int mode = 0; mode < n_modes; ++mode)
    {
      const Eigen::Vector3d velocity = amplitudes[node.body][mode] * rigid_velocity(mode, arm);
      for (unsigned int d = 0; d < dim; ++d)
        state.velocity.local_element(node.dofs[d]) += velocity[d];
    }
  }
  discretization.distribute(state.velocity);
}
} // namespace

template <int dim>
VectorAndMoment adapt_in_motion(Scene<dim> &scene, Discretization<dim> &discretization, State &state,
                                PointValues &memory)
{
  const std::vector<Freedom> freedoms = find_freedoms(scene);
  const unsigned int n_bodies = scene.n_bodies();
  const Vector old_mass = make_lumped_mass(scene.materials, discretization);
  const auto centres = means_by_body(discretization, n_bodies, old_mass,
                                     [&](const OwnedNode<dim> &node) -> Eigen::Vector3d
                                     { return position_of(node) + nodal_value(node, state.displacement); });
  const std::vector<BodySums> before = measure(discretization, old_mass, centres, state);
  const auto displacements = fit_affine_fields(discretization, freedoms, state.displacement);
  const auto velocities = fit_affine_fields(discretization, freedoms, state.velocity);
  add_affine_fields(discretization, displacements, -1., state.displacement);
  add_affine_fields(discretization, velocities, -1., state.velocity);
  discretization.adapt({&state.displacement, &state.velocity}, memory);
  add_affine_fields(discretization, displacements, 1., state.displacement);
  add_affine_fields(discretization, velocities, 1., state.velocity);

  const auto volumes = measure(discretization, make_nodal_volume(discretization), centres, state);
  for (unsigned int body = 0; body < n_bodies; ++body)
    scene.materials[body].density = before[body][0] / volumes[body][0];
  const auto after =
      measure(discretization, make_lumped_mass(scene.materials, discretization), centres, state);
  VectorAndMoment changes;
  std::vector<ByMode> amplitudes;
  for (unsigned int body = 0; body < n_bodies; ++body)
  {
    const ByMode missing = momenta(before[body]) - momenta(after[body]);
    amplitudes.push_back(find_correction(after[body], freedoms[body], dim, missing));
    add_changes_by_supports(missing - mode_products(after[body]) * amplitudes.back(), freedoms[body], dim,
                            centres[body], changes);
  }
  add_rigid_velocities(discretization, centres, amplitudes, state);
  return changes;
}

template VectorAndMoment adapt_in_motion(Scene<2> &, Discretization<2> &, State &, PointValues &);
template VectorAndMoment adapt_in_motion(Scene<3> &, Discretization<3> &, State &, PointValues &);
} // namespace signorini
