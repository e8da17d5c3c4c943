#include <talus/postprocess/particle_output.h>

#include "fixture.h"

using namespace dealii;
using namespace Test;

namespace
{
  template <int dim>
  std::vector<double> evaluate(const WorkingSet<dim> &set, const std::string &name)
  {
    const auto          field = select_particle_fields(set, {name}, "/Output", "Particle fields")[0];
    std::vector<double> values(field.components.size());
    field.evaluate(set, 0, values.data());
    return values;
  }

  template <int dim>
  void set_stress(WorkingSet<dim> &set, const std::vector<double> &stress)
  {
    for (unsigned int c = 0; c < set.n_stress; ++c)
      set.component(set.stress, c)[0] = stress[c];
  }

  /** Von Mises stress and pressure of stresses for which they are known. */
  template <int dim>
  void check_stress(WorkingSet<dim> &set)
  {
    const std::string d = " in " + std::to_string(dim) + "D";
    for (const unsigned int axis : {0, 1, 2})
    {
      std::vector<double> stress(6, 0.);
      stress[axis] = -3e5;
      set_stress(set, stress);
      check("von Mises of uniaxial stress" + d, evaluate(set, "von Mises stress")[0] - 3e5, 1e-9);
      check("pressure of uniaxial compression" + d, evaluate(set, "pressure")[0] - 1e5, 1e-9);
    }
    set_stress(set, {0, 0, 0, 2., 0, 0});
    check("von Mises of shear" + d, evaluate(set, "von Mises stress")[0] - 2 * std::sqrt(3.), 1e-14);
    set_stress(set, {7., 7., 7., 0, 0, 0});
    check("von Mises of tension on all sides" + d, evaluate(set, "von Mises stress")[0], 1e-14);
    check("pressure of tension on all sides" + d, evaluate(set, "pressure")[0] + 7., 1e-14);
    if (dim == 3)
    {
      // sqrt(3 (1 + 4 + 9)) with all three shears
      set_stress(set, {0, 0, 0, 1., 2., 3.});
      check("von Mises of three shears", evaluate(set, "von Mises stress")[0] - std::sqrt(42.), 1e-14);
    }
  }

  template <int dim>
  void check_others(WorkingSet<dim> &set)
  {
    const std::string d = " in " + std::to_string(dim) + "D";
    for (unsigned int i = 0; i < dim; ++i)
    {
      set.component(set.initial_position, i)[0] = 1. + i;
      set.component(set.position, i)[0]         = 1.5 + 2 * i;
      set.component(set.velocity, i)[0]         = 1. + i;
      set.component(set.F, i * dim + i)[0]      = 2.;
    }
    set.component(set.F, 1)[0]      = 0.5; // F_xy
    set.component(set.F, dim)[0]    = 0.5; // F_yx
    set.component(set.mass, 0)[0]   = 6.;
    set.component(set.volume, 0)[0] = 4.;
    for (unsigned int i = 0; i < dim; ++i)
      check("displacement" + d, evaluate(set, "displacement")[i] - (0.5 + i), 1e-15);
    check("density" + d, evaluate(set, "density")[0] - 1.5, 1e-15);
    check("volume ratio" + d, evaluate(set, "volume ratio")[0] - (dim == 2 ? 3.75 : 7.5), 1e-14);
    // rho v^2 / 2 with v^2 = 5 or 14
    check("kinetic energy density" + d, evaluate(set, "kinetic energy density")[0] - .75 * (dim == 2 ? 5 : 14), 1e-14);
  }

  /** F = R diag(a, b, c): Hencky's strains are the logarithms; a rotating body has twice its angular velocity. */
  template <int dim>
  void check_kinematics(WorkingSet<dim> &set)
  {
    const std::string d         = " in " + std::to_string(dim) + "D";
    const double      stretch[] = {2., 0.9, dim == 2 ? 1. : 1.1}, cos = std::cos(0.7), sin = std::sin(0.7);
    const double      R[3][3]    = {{cos, -sin, 0}, {sin, cos, 0}, {0, 0, 1}};
    const double      spin[3][3] = {{1, -3, 2}, {3, 2, -1}, {-2, 1, 3}}; // angular velocity (1, 2, 3) and stretching
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
      {
        set.component(set.F, i * dim + j)[0]      = R[i][j] * stretch[j];
        set.component(set.grad_v, i * dim + j)[0] = spin[i][j];
      }
    const double x = std::log(2.), y = std::log(0.9), z = std::log(stretch[2]);
    const double expected = std::sqrt(2 * ((x - y) * (x - y) + (y - z) * (y - z) + (z - x) * (z - x))) / 3;
    check("deviatoric strain" + d, evaluate(set, "deviatoric strain")[0] - expected, 1e-14);
    for (unsigned int i = 0; i < (dim == 2 ? 1 : 3); ++i)
      check("vorticity" + d, evaluate(set, "vorticity")[i] - (dim == 2 ? 6. : 2. * (i + 1)), 1e-14);
    set.component(set.F, 0)[0] = 1 + 1e-5, set.component(set.F, 1)[0] = set.component(set.F, dim)[0] = 0;
    set.component(set.F, dim + 1)[0] = 1;
    if (dim == 3)
      set.component(set.F, 8)[0] = 1;
    // Small strains need more than half of the digits.
    check("small deviatoric strain" + d, evaluate(set, "deviatoric strain")[0] - std::log(1 + 1e-5) * 2 / 3,
          1e-10 * 1e-5);
  }

  template <int dim>
  void check_names(const std::string &expected)
  {
    WorkingSet<dim> set;
    set.add_field("plastic strain", dim == 2 ? 4 : 6);
    set.add_field("density", 1); // the stored one is taken
    std::string names;
    for (const auto &field :
         select_particle_fields(set, {"velocity", "stress", "velocity", "velocity gradient", "plastic strain"}, "", ""))
      for (const auto &name : field.components)
        names += name + " ";
    check_true("names of components: " + names, names == expected);
    set.resize(1);
    set.component(set.add_field("density", 1), 0)[0] = 3.;
    check_true("a stored field is taken before a derived one", evaluate(set, "density")[0] == 3.);
  }
} // namespace

void test_fields()
{
  WorkingSet<2> plane;
  plane.resize(1);
  WorkingSet<3> space;
  space.resize(1);
  check_stress(plane);
  check_stress(space);
  check_others(plane);
  check_others(space);
  plane.material_begin = {0, 0, 1};
  plane.body[0]        = 3;
  check_true("body and material", evaluate(plane, "body")[0] == 3 && evaluate(plane, "material")[0] == 1);
  check_kinematics(plane);
  check_kinematics(space);
  check_names<2>("velocity_x velocity_y stress_xx stress_yy stress_zz stress_xy velocity_gradient_xx "
                 "velocity_gradient_xy velocity_gradient_yx velocity_gradient_yy plastic_strain_xx plastic_strain_yy "
                 "plastic_strain_zz plastic_strain_xy ");
  check_names<3>("velocity_x velocity_y velocity_z stress_xx stress_yy stress_zz stress_xy stress_xz stress_yz "
                 "velocity_gradient_xx velocity_gradient_xy velocity_gradient_xz velocity_gradient_yx "
                 "velocity_gradient_yy velocity_gradient_yz velocity_gradient_zx velocity_gradient_zy "
                 "velocity_gradient_zz plastic_strain_xx plastic_strain_yy plastic_strain_zz plastic_strain_xy "
                 "plastic_strain_xz plastic_strain_yz ");
  const auto select = [&](const std::string &name) {
    select_particle_fields(plane, {"velocity", name}, "/Output", "Particle fields");
  };
  check_throws<EntryError>("a misspelt field", "Did you mean 'pressure'?", [&] { select("presure"); });
  check_throws<EntryError>("an unknown field lists the choices", "stress, mass, volume", [&] { select("colour"); });
}

namespace
{
  /** Gives each particle values by which it can be recognised. */
  template <int dim>
  void mark(Talus::Particles<dim> &particles)
  {
    for (unsigned int p = 0; p < particles.size(); ++p)
    {
      for (unsigned int d = 0; d < dim; ++d)
        particles.component(particles.velocity, d)[p] = std::sqrt(1. + d + particles.id[p]);
      for (unsigned int c = 0; c < particles.n_stress; ++c)
        particles.component(particles.stress, c)[p] = -1. / (1. + c + particles.id[p]);
    }
  }

  template <int dim>
  void check_csv(const std::string &header)
  {
    const std::string d = " in " + std::to_string(dim) + "D";
    Fixture<dim>      run;
    run.create();
    mark(run.particles);
    check_true("two ranks share the body" + d,
               run.particles.size() > 0 || Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) > 2);
    const std::string file   = scratch() + "/particles.csv";
    const auto        fields = select_particle_fields(run.particles, {"velocity", "stress"}, "/Output", "Fields");
    write_particle_csv(file, run.particles, fields, 0.1, MPI_COMM_WORLD);

    const auto table = lines(file);
    check_true("units come first" + d,
               table[0].find("# time 0.1 [time]; units: id [1], body [1], material [1], x [length]") == 0);
    check_true("and hold each column's" + d, table[0].find(", stress_xy [stress]") != std::string::npos);
    check_true("names of the columns" + d, table[1] == header);
    check_true("a row for each particle" + d, table.size() == run.particles.n_global + 2);
    double       previous = -1, error = 0;
    unsigned int n_disorder = 0;
    for (unsigned int i = 2; i < table.size(); ++i)
    {
      const auto   row = read_numbers(table[i]);
      const double id  = row[0];
      n_disorder += id <= previous;
      previous = id;
      for (unsigned int k = 0; k < dim; ++k)
        error = std::max(error, std::abs(row[3 + dim + k] - std::sqrt(1. + k + id)));
      for (unsigned int c = 0; c < run.particles.n_stress; ++c)
        error = std::max(error, std::abs(row[3 + 2 * dim + c] + 1. / (1. + c + id)));
      // Lattice of points at 1/8 + k/4 with 16 points along x, 4 along the others, x first.
      const unsigned int k = static_cast<unsigned int>(id);
      error                = std::max(error, std::abs(row[3] - (k % 16 + .5) / 4));
      error                = std::max(error, std::abs(row[4] - (k / 16 % 4 + .5) / 4));
    }
    check_true("sorted by id" + d, n_disorder == 0);
    check("each particle has its own values" + d, error, 1e-15);
  }
} // namespace

void test_particle_csv()
{
  check_csv<2>("id,body,material,x,y,velocity_x,velocity_y,stress_xx,stress_yy,stress_zz,stress_xy");
  check_csv<3>(
    "id,body,material,x,y,z,velocity_x,velocity_y,velocity_z,stress_xx,stress_yy,stress_zz,stress_xy,stress_xz,stress_yz");
}
