// SPDX-License-Identifier: LGPL-2.1-or-later
#pragma once

#include "signorini/base/triple.h"
#include "signorini/mesh/simplex_mesh.h"

#include <array>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

/// Plain structs, one a subsection of the parameter file, filled and checked by read_parameters(). Units
/// are SI or any other consistent set.
namespace signorini
{
/// `subsection Mesh` of a body: generated, of hexahedra (quadrilaterals) or tetrahedra (triangles), or
/// tetrahedra from a file.
///
/// Boundaries are named after the shape: box: left, right (−x, +x), front, back (−y, +y; in 2-D bottom, top
/// are −y, +y), bottom, top (−z, +z). ball: surface, and for parts of a ball x, y, z for the cuts x = 0, y =
/// 0, z = 0. cylinder (axis z; 3-D only): side, bottom, top. file: see read_mesh_file() and load_geometry().
struct MeshParameters
{
  enum class CellType
  {
    hexahedra, ///< quadrilaterals in 2-D
    tetrahedra ///< triangles in 2-D
  };
  enum class Shape
  {
    box,
    ball,
    cylinder,
    file ///< a mesh, or a shape that Gmsh can mesh; tetrahedra only
  };
  /// Which part of a ball: whole; the half with last coordinate ≥ 0; the positive quadrant or octant.
  enum class Part
  {
    whole,
    half,
    orthant
  };
  /// Cells near a point (or within a distance of a face's plane) are refined further.
  struct Grading
  {
    Triple point{}; ///< centre of refinement, in the body's own coordinates before placement [m]
    std::optional<std::string> boundary; ///< instead of a point: refine towards the boundary of this name
    double distance = 0.;                ///< cells nearer than this get all levels [m]
    unsigned int levels = 0; ///< additional refinements there; each level less doubles the distance
  };

  CellType cell_type = CellType::hexahedra;
  Shape shape = Shape::box;
  Part part = Part::whole;
  Triple lower_corner{};                      ///< box [m]
  Triple upper_corner{1., 1., 1.};            ///< box [m]
  std::array<unsigned int, 3> cells{1, 1, 1}; ///< box: coarse cells a direction
  double radius = 1.;                         ///< ball, cylinder [m]
  double length = 1.;                         ///< cylinder [m]
  double element_size =
      0.;           ///< tetrahedra of Gmsh: length of edges, halved by every refinement; 0: a cut box [m]
  std::string file; ///< as it can be opened from the working directory
  std::vector<std::string> regions;                ///< of the file, those that are the body; none: all
  std::shared_ptr<const SimplexMesh> mesh_of_file; ///< checked; null unless the shape is that of a mesh file
  std::shared_ptr<const SimplexMesh>
      surface_of_file;          ///< faces only; null unless Gmsh shall mesh the file's shape
  unsigned int refinements = 0; ///< global refinements of the coarse mesh
  std::optional<Grading> grading;
};

/// `subsection Placement` of a body: x ← shift + rotation·(scale·x).
struct PlacementParameters
{
  Triple shift{};             ///< [m]
  double rotation_angle = 0.; ///< [degrees]
  Triple rotation_axis{0., 0., 1.};
  double scale = 1.;
};

/// `subsection Material` of a body.
struct MaterialParameters
{
  enum class Model
  {
    linear_elastic, ///< small strain
    neo_hookean,    ///< compressible, finite strain
    plastic         ///< elastic and plastic, finite strain
  };
  Model model = Model::linear_elastic;
  double youngs_modulus = 0.;    ///< E > 0 [Pa]
  double poissons_ratio = 0.;    ///< −1 < ν < 0.5
  double density = 0.;           ///< ρ > 0 [kg/m³]
  double viscosity = 0.;         ///< η [Pa s]; 0: none
  double yield_stress = 0.;      ///< plastic: σ_y > 0 [Pa]
  double hardening_modulus = 0.; ///< plastic: slope of the yield stress over the plastic strain, ≥ 0 [Pa]
};

/// `subsection Support NAME` of a body: prescribed displacement on the boundary NAME; a component left out is
/// free.
struct SupportParameters
{
  std::string boundary;
  std::array<std::optional<std::string>, 3> displacement; ///< muParser expressions of x, y, z, t [m]
  std::array<std::string, 3> places;                      ///< file and line of each component
};

/// `subsection Load NAME` of a body: a dead traction per undeformed area on the boundary NAME.
struct LoadParameters
{
  std::string boundary;
  std::array<std::string, 3> traction{{"0", "0", "0"}}; ///< muParser expressions of x, y, z, t [Pa]
  std::string place;                                    ///< file and line
};

/// `subsection Body NAME`.
struct BodyParameters
{
  std::string name;
  MeshParameters mesh;
  PlacementParameters placement;
  MaterialParameters material;
  Triple initial_velocity{}; ///< [m/s]
  Triple initial_spin{}; ///< angular velocity about the centre of mass; in 2-D only the third counts [rad/s]
  std::vector<SupportParameters> supports;
  std::vector<LoadParameters> loads;
};

/// `subsection Obstacle NAME`.
struct ObstacleParameters
{
  enum class Shape
  {
    plane,
    sphere,
    cylinder,
    box
  };
  std::string name;
  Shape shape = Shape::plane;
  Triple point{};            ///< a point of the plane or the axis, or the centre of the sphere or the box [m]
  Triple normal{0., 0., 1.}; ///< plane: points to where bodies may be
  Triple axis{0., 0., 1.};   ///< cylinder: direction
  double radius = 1.;        ///< sphere and cylinder [m]
  Triple lower_corner{};     ///< box [m]
  Triple upper_corner{};     ///< box [m]
  std::vector<std::string> displacement; ///< a formula of t for each component [m]; empty: fixed
  std::string place_of_displacement;     ///< for messages
};

/// `subsection Damping` in `subsection Contact`.
struct DampingParameters
{
  double damping_ratio = 0.; ///< ξ ≥ 0
};

/// `subsection Friction` in `subsection Contact`.
struct FrictionParameters
{
  double coefficient = 0.; ///< μ ≥ 0
};

/// `subsection Correction` in `subsection Contact`.
struct CorrectionParameters
{
  double tolerance = 1e-4;     ///< largest change of the pressures from step to step, relative
  unsigned int max_steps = 30; ///< in one load step
};

/// `subsection Contact`.
struct ContactParameters
{
  enum class Integration
  {
    automatic, ///< face segments in quasi-static runs without friction, else face quadrature
    face_quadrature,
    face_segments
  };
  enum class Potential
  {
    surface, ///< by the depth below the other body's surface
    volume   ///< by the overlap of elements
  };
  Potential potential = Potential::surface;
  std::optional<double> penalty_factor = 10.; ///< α > 0; none: chosen by the estimated errors
  double contact_share =
      0.25; ///< of the squared error by contact in that of discretisation, for the choice of α
  Integration integration = Integration::automatic;
  std::optional<unsigned int> quadrature_points; ///< a direction; none: by what touches
  std::vector<std::pair<std::string, std::string>>
      excluded_pairs;                    ///< names of two bodies, or a body and an obstacle
  std::vector<std::string> self_contact; ///< bodies that may touch themselves
  bool allow_initial_overlap = false;
  double max_penetration = 0.5; ///< over the size of an element: deeper, the run stops
  std::optional<DampingParameters> damping;
  std::optional<FrictionParameters> friction;
  std::optional<CorrectionParameters> correction; ///< quasi-static runs
};

/// `subsection Quasi-static`.
struct QuasiStaticParameters
{
  enum class LinearSolver
  {
    automatic, ///< by size
    direct,
    cg_ic, ///< with friction as cg_amg
    cg_amg
  };
  double end_time = 1.;
  unsigned int load_steps = 1;
  double tolerance = 1e-9;          ///< relative residual force of every body
  unsigned int max_iterations = 50; ///< of Newton in one load step
  unsigned int max_bisections = 8;  ///< of a load step that fails
  LinearSolver linear_solver = LinearSolver::automatic;
};

/// `subsection Explicit`.
struct ExplicitParameters
{
  enum class ContactStepping
  {
    explicit_forces, ///< of the positions at the start of a step
    implicit_forces  ///< of those at its end, found on the nodes near contact
  };
  double end_time = 1.;          ///< [s]
  double bulk_step_factor = 0.9; ///< share of the linear stability bound of the bodies
  double contact_step_factor =
      0.5; ///< share of the bound with contact springs: unilateral contact needs less than 1
  ContactStepping contact_stepping = ContactStepping::explicit_forces;
  double ledger_tolerance =
      0.05; ///< stop when the energy ledger is open by more, relative to the largest energy
};

/// `subsection Implicit`.
struct ImplicitParameters
{
  using LinearSolver = QuasiStaticParameters::LinearSolver;
  double end_time = 1.;             ///< [s]
  double time_step = 0.;            ///< the longest [s]
  unsigned int max_bisections = 12; ///< of a step
  double step_tolerance = 0.;       ///< largest unsteadiness of a step, 0: any
  double tolerance = 1e-9;          ///< relative residual force of every body
  unsigned int max_iterations = 50; ///< of Newton in one step
  double ledger_tolerance =
      0.05; ///< stop when the energy ledger is open by more, relative to the largest energy
  LinearSolver linear_solver = LinearSolver::automatic;
};

/// The solvers of a run.
using SolverParameters = std::variant<QuasiStaticParameters, ExplicitParameters, ImplicitParameters>;

/// `subsection Exact solution`: what the run is measured against.
struct ExactSolutionParameters
{
  std::string name;                      ///< entry of the table of exact solutions
  std::map<std::string, double> values;  ///< its numerical parameters, all present
  std::vector<std::string> displacement; ///< its displacement as formulas of x, y, z, t, one a component [m]
};

/// `subsection Output`.
struct OutputParameters
{
  std::string directory;           ///< default: output/NAME of the parameter file
  unsigned int n_fields = 10;      ///< how many VTU files a run writes, beside the first
  unsigned int n_statistics = 200; ///< about how many rows of statistics.csv an explicit run writes
};

/// `subsection Checkpoint`.
struct CheckpointParameters
{
  double interval = 600.; ///< from one checkpoint to the next [s of run time]
};

/// `subsection Adaptivity`. Target error and cycles are of quasi-static runs, interval and levels of explicit
/// ones.
struct AdaptivityParameters
{
  unsigned int interval = 20;         ///< steps from one adaptation to the next
  unsigned int max_levels = 2;        ///< refinements of a cell of the file's mesh at most
  unsigned int max_cycles = 8;        ///< of solving, estimating and refining in one load step
  double refine_share = 0.5;          ///< cells with this share of the squared error are refined
  double coarsen_share = 0.01;        ///< cells with this share are made coarser
  double target_error = 0.;           ///< relative error in the energy norm to stop at; 0: none
  unsigned int max_n_dofs = 10000000; ///< no refinement beyond
};

/// `subsection Study`: the runs of a study, and how they are compared.
struct StudyParameters
{
  /// What runs of a study differ in.
  enum class Factor
  {
    uniform_refinements, ///< levels added to the mesh of every body, without adaptivity
    adaptive_cycles,     ///< Adaptivity/Maximum cycles
    degree,
    potential,
    penalty_factor,
    linear_solver,
    contact_stepping,
    step_factor, ///< multiplies both step factors of `Explicit`
    copies       ///< Number of the `Copies` of every body that has them
  };
  std::map<Factor, std::vector<std::string>> values; ///< as in the file; absent: the file's own value
  unsigned int n_repeats = 1;                        ///< of every run
  double tolerance = 0.01;                           ///< largest error of the run that is sought
  std::vector<std::string> quantities;               ///< whose errors count, at least one
  std::map<std::string, double> model_errors; ///< by quantity: taken off the relative error of every run
  unsigned int max_n_dofs = 1000000;          ///< runs with more are left out
};

struct Parameters
{
  unsigned int dimension = 3;
  unsigned int degree = 1; ///< of all elements, 1 or 2
  Triple gravity{};        ///< [m/s²]
  std::vector<BodyParameters> bodies;
  std::vector<ObstacleParameters> obstacles;
  std::optional<ContactParameters> contact;
  SolverParameters solver;
  std::optional<AdaptivityParameters> adaptivity;
  std::optional<ExactSolutionParameters> exact_solution;
  std::optional<StudyParameters> study;
  OutputParameters output;
  std::optional<CheckpointParameters> checkpoint;
};
} // namespace signorini
