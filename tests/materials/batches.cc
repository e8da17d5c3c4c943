#include "point.h"

using namespace Test;

namespace
{
  /** n particles of a material in wild states, with columns as the working set has them. */
  struct ParticleColumns
  {
    ParticleColumns(const Material &material, const unsigned int n, const unsigned int dim) :
      n(n), columns(9 + 9 + 6 + 2 + material.state_names().size(), std::vector<double>(n + 2, guard))
    {
      const auto column = [&](const unsigned int c) { return columns[c].data(); };
      range.begin       = 1; // the first and the last are not of this material
      range.end         = n + 1;
      range.dt          = 1e-2;
      range.state.fill(nullptr);
      for (unsigned int c = 0; c < 9; ++c)
      {
        const bool is_stored = dim == 3 || (c / 3 < 2 && c % 3 < 2);
        range.grad_v[c]      = is_stored ? column(c) : nullptr;
        range.F[c]           = is_stored ? column(9 + c) : nullptr;
      }
      for (unsigned int c = 0; c < 6; ++c)
        range.stress[c] = dim == 3 || c < 4 ? column(18 + c) : nullptr;
      range.mass   = column(24);
      range.volume = column(25);
      for (unsigned int s = 0; s < material.state_names().size(); ++s)
        range.state[s] = column(26 + s);
      for (unsigned int p = 1; p <= n; ++p)
      {
        const Tensor<2, 3> A = some_tensor(0.9 * p), S = 4. * (some_tensor(1.7 * p) + transpose(some_tensor(1.7 * p)));
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
          {
            columns[3 * i + j][p]     = A[i][j];
            columns[9 + 3 * i + j][p] = (i == j) + 0.2 * A[j][i];
          }
        // Every third is weak, every third under pressure, every third pulled on all sides.
        const double share = p % 3 == 0 ? 0.01 : 1, mean = p % 3 == 1 ? -20 : p % 3 == 2 ? 20 : 0;
        for (unsigned int c = 0; c < 6; ++c)
          columns[18 + c][p] = share * (c < 3 ? S[c][c] + mean : S[c == 5 ? 1 : 0][c == 3 ? 1 : 2]);
        columns[24][p] = 1 + 0.1 * std::sin(1. * p);
        columns[25][p] = 1 + 0.1 * std::sin(2. * p);
        for (unsigned int s = 0; s < material.state_names().size(); ++s)
          columns[26 + s][p] = 0.01 * p;
      }
    }

    /** Everything that a step changes, and what can be asked after it. */
    std::vector<double> advance(const Material &material, const bool is_plain)
    {
      range.is_plain = is_plain;
      material.update(range);
      std::vector<double> speeds(n), densities(n), all;
      material.wave_speeds(range, speeds.data());
      material.strain_energy_densities(range, densities.data());
      for (const auto &column : columns)
        all.insert(all.end(), column.begin(), column.end());
      all.insert(all.end(), speeds.begin(), speeds.end());
      all.insert(all.end(), densities.begin(), densities.end());
      return all;
    }

    static constexpr double guard = 12345;

    unsigned int                     n;
    std::vector<std::vector<double>> columns;
    MaterialRange                    range;
  };
} // namespace

/** A batch gives what its particles give one by one, whatever its lanes do; and leaves the neighbours alone. */
void batches()
{
  const std::string                             elastic = set("Young's modulus", "70") + set("Poisson's ratio", "0.2");
  const std::string                             soft    = elastic + set("Yield stress", "3");
  const std::vector<std::array<std::string, 3>> laws{
    {{"linear elastic", "linear elastic", elastic}},
    {{"neo-Hookean", "neo-Hookean", elastic}},
    {{"Hooke", "Hooke", elastic}},
    {{"perfect", "von Mises", soft}},
    {{"linear", "von Mises", soft + set("Hardening", "linear") + set("Hardening modulus", "5")}},
    {{"softening", "von Mises",
      soft + set("Hardening", "exponential softening") + set("Residual yield stress", "1") +
        set("Softening rate", "20")}},
    {{"Hencky", "Hencky",
      elastic + set("Yield stress", "12") + set("Hardening", "exponential softening") +
        set("Residual yield stress", "1") + set("Softening rate", "5")}},
    {{"sand", "Drucker-Prager",
      elastic + set("Friction angle", "35") + set("Dilatancy angle", "10") + set("Cohesion", "1")}},
    {{"dry sand", "Drucker-Prager", elastic + set("Friction angle", "35") + set("Dilatancy angle", "10")}},
    {{"Mohr-Coulomb", "Mohr-Coulomb",
      elastic + set("Friction angle", "35") + set("Dilatancy angle", "10") + set("Cohesion", "1") +
        set("Tension strength", "0.3") + set("Residual cohesion", "0.5")}},
    {{"fluid", "Newtonian fluid", set("Density", "1")}}};
  for (const auto &[name, type, entries] : laws)
    for (const unsigned int dim : {2, 3})
    {
      SinglePoint     owner(type, entries, dim);
      const Material &material   = *owner.material;
      double          difference = 0, beyond = 0;
      unsigned int    n_elastic = 0, n_plastic = 0, n_apex = 0;
      for (unsigned int n = 1; n <= 20; ++n)
      {
        ParticleColumns plain(material, n, dim), batched(material, n, dim);
        const auto      before = plain.columns;
        const auto      a = plain.advance(material, true), b = batched.advance(material, false);
        for (unsigned int i = 0; i < a.size(); ++i)
          raise(difference, (a[i] - b[i]) / (1 + std::abs(a[i])));
        for (const auto &column : batched.columns)
          beyond = std::max(
            {beyond, std::abs(column[0] - ParticleColumns::guard), std::abs(column[n + 1] - ParticleColumns::guard)});
        if (!material.state_names().empty())
          for (unsigned int p = 1; p <= n; ++p)
          {
            ++(plain.columns[26][p] > before[26][p] ? n_plastic : n_elastic);
            n_apex += std::abs(plain.columns[21][p]) < 1e-13;
          }
      }
      check(name + " in " + std::to_string(dim) + "D", difference, 1e-13);
      check(name + ", particles beyond the range", beyond, 0.);
      if (!material.state_names().empty())
        check_true(name + ", elastic and plastic lanes", n_elastic > 20 && n_plastic > 20);
      if (name == "sand")
        check_true("apex lanes", n_apex > 20);
    }
}
