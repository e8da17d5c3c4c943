#include <talus/postprocess/energies.h>

#include "fixture.h"

#include <algorithm>

using namespace dealii;
using namespace Test;

namespace
{
  // Sums by hand of particles k = 0 .. 3 with m = 1 + k, x = (k, 2), v = (1, k), V = 2.
  template <int dim>
  struct Expected;
  template <>
  struct Expected<2>
  {
    // sum m v^2 / 2 = sum (1 + k)(1 + k^2) / 2 = (1 + 4 + 15 + 40) / 2
    static constexpr double kinetic_energy = 30;
    // sum m (x v_y - y v_x) = sum (1 + k)(k^2 - 2) = -2 - 2 + 6 + 28
    static constexpr double angular_momentum = 30;
  };

  template <int dim>
  void add_particle(WorkingSet<dim> &set, const unsigned int k, const Tensor<1, dim> &x, const Tensor<1, dim> &v)
  {
    const unsigned int p = set.size();
    set.resize(p + 1);
    set.id[p] = k;
    for (unsigned int d = 0; d < dim; ++d)
    {
      set.component(set.position, d)[p] = x[d];
      set.component(set.velocity, d)[p] = v[d];
    }
    set.component(set.mass, 0)[p]   = 1. + k;
    set.component(set.volume, 0)[p] = 2.;
    set.component(set.stress, 1)[p] = 3.; // uniaxial: energy density 9 / (2 E)
  }

  bool is_mine(const unsigned int k)
  {
    return k % Utilities::MPI::n_mpi_processes(MPI_COMM_WORLD) == Utilities::MPI::this_mpi_process(MPI_COMM_WORLD);
  }

  std::vector<std::unique_ptr<Material>> elastic(Parameters &parameters)
  {
    std::vector<std::unique_ptr<Material>> materials;
    materials.push_back(Registry<Material>::get().make("linear elastic", parameters, "/Materials/m")); // E = 1e6
    return materials;
  }

  void check_plane()
  {
    auto          parameters = Parameters::from_text("");
    const auto    materials  = elastic(parameters);
    const auto    transfer   = Registry<Transfer<2>>::get().make("APIC", parameters, "/Transfer");
    WorkingSet<2> set;
    transfer->add_fields(set);
    const unsigned int B = set.add_field("affine moment", 4);
    for (unsigned int k = 0; k < 4; ++k)
      if (is_mine(k))
      {
        Tensor<1, 2> x, v;
        x[0] = k, x[1] = 2, v[0] = 1, v[1] = k;
        add_particle(set, k, x, v);
        set.component(B, 1)[set.size() - 1] = 0.5; // B_xy: -0.5 m
        set.component(B, 2)[set.size() - 1] = 2.;  // B_yx: +2 m
      }
    set.add_states({});
    set.material_begin = {0, set.size()};

    const Totals<2> sum = totals(set, *transfer, materials, MPI_COMM_WORLD);
    check("mass", sum.mass - 10, 1e-14);
    check("volume", sum.volume - 8, 1e-14);
    check("momentum x", sum.momentum[0] - 10, 1e-14);
    check("momentum y", sum.momentum[1] - (2 + 6 + 12), 1e-14);
    check("kinetic energy", sum.kinetic_energy - Expected<2>::kinetic_energy, 1e-13);
    check("strain energy", sum.strain_energy / (8 * 9 / 2e6) - 1, 1e-14);
    check("angular momentum", sum.angular_momentum[0] - Expected<2>::angular_momentum, 1e-13);
    check("angular momentum with B", sum.total_angular_momentum[0] - (Expected<2>::angular_momentum + 15), 1e-13);

    Talus::Table table;
    sum.add_to(table);
    const auto &columns = table.columns();
    const auto  row     = table.row();
    check_true("a value for each column", columns.size() == row.size());
    const auto of = [&](const std::string &name) {
      const auto column =
        std::find_if(columns.begin(), columns.end(), [&](const auto &other) { return other.name == name; });
      return column == columns.end() ? 1e300 : row[column - columns.begin()];
    };
    check_true("columns and values agree",
               of("momentum y") == sum.momentum[1] && of("total angular momentum z") == sum.total_angular_momentum[0]);
    check("greatest speed", of("greatest speed") - std::sqrt(10.), 1e-15);
    check("how far they reach along x", std::max(std::abs(of("least x")), std::abs(of("greatest x") - 3)), 1e-300);
    check("and along y", std::max(std::abs(of("least y") - 2), std::abs(of("greatest y") - 2)), 1e-300);

    const auto tpic = Registry<Transfer<2>>::get().make("TPIC", parameters, "/Transfer");
    check("a transfer without B adds nothing",
          totals(set, *tpic, materials, MPI_COMM_WORLD).total_angular_momentum[0] - Expected<2>::angular_momentum,
          1e-13);
  }

  /** A rigid rotation: m (x cross (w cross x)), and with B = W d: 2 m d w more. */
  void check_space()
  {
    auto          parameters = Parameters::from_text("");
    const auto    materials  = elastic(parameters);
    const auto    transfer   = Registry<Transfer<3>>::get().make("APIC", parameters, "/Transfer");
    WorkingSet<3> set;
    transfer->add_fields(set);
    const unsigned int B = set.add_field("affine moment", 9);
    Tensor<1, 3>       w, expected;
    w[0] = 1, w[1] = -2, w[2] = 3;
    const double d = 0.25;
    double       m = 0;
    for (unsigned int k = 0; k < 5; ++k)
    {
      Tensor<1, 3> x;
      x[0] = k, x[1] = 1. - k, x[2] = 0.5 * k;
      m += 1. + k;
      expected += (1. + k) * (x.norm_square() * w - (x * w) * x); // x cross (w cross x)
      if (!is_mine(k))
        continue;
      add_particle(set, k, x, cross_product_3d(w, x));
      // v_j = eps_jlk w_l x_k: W = [[0, -wz, wy], [wz, 0, -wx], [-wy, wx, 0]]
      const double W[] = {0, -w[2], w[1], w[2], 0, -w[0], -w[1], w[0], 0};
      for (unsigned int c = 0; c < 9; ++c)
        set.component(B, c)[set.size() - 1] = d * W[c];
    }
    set.add_states({});
    set.material_begin  = {0, set.size()};
    const Totals<3> sum = totals(set, *transfer, materials, MPI_COMM_WORLD);
    for (unsigned int i = 0; i < 3; ++i)
    {
      check("angular momentum of a rotation", sum.angular_momentum[i] - expected[i], 1e-12);
      check("and with B", sum.total_angular_momentum[i] - expected[i] - 2 * m * d * w[i], 1e-12);
    }
  }
} // namespace

void test_totals()
{
  check_plane();
  check_space();
}
