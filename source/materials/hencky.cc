#include <talus/core/eigen.h>
#include <talus/core/registry.h>
#include <talus/materials/hencky.h>
#include <talus/materials/point.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    // Places among the states.
    constexpr unsigned int plastic_strain = 0, elastic_strain = 1;

    /** b_e - I. */
    template <class Point>
    typename Point::Symmetric elastic_part(const Point &point)
    {
      typename Point::Symmetric value;
      for (unsigned int c = 0; c < Point::n_stress; ++c)
        value.access_raw_entry(c) = 2. * point.state(elastic_strain + c);
      return value;
    }

    template <class Point>
    void set_elastic_part(const Point &point, const typename Point::Symmetric &value)
    {
      for (unsigned int c = 0; c < Point::n_stress; ++c)
        point.set_state(elastic_strain + c, 0.5 * value.access_raw_entry(c));
    }

    /** f b f^T - I with f = I + g, of b - I, without the loss of digits of a one that comes and goes. */
    template <typename Number>
    SymmetricTensor<2, 3, Number> push_forward(const Tensor<2, 3, Number> &g, const SymmetricTensor<2, 3, Number> &b)
    {
      const Tensor<2, 3, Number> e(b), half = e + g * e; // f (b - I)
      return symmetrize(half + half * transpose(g) + g + transpose(g) + g * transpose(g));
    }

    /** J = sqrt(det b_e). */
    template <class Point>
    auto volume_ratio(const Point &point)
    {
      auto b = elastic_part(point);
      for (unsigned int d = 0; d < 3; ++d)
        b[d][d] += 1.;
      return sqrt(determinant(b));
    }

    template <class Law>
    void logarithmic_return(const MaterialRange &range, const double K, const double G, const Law &law)
    {
      for_each_point(range, [K, G, law](const auto &point) {
        using Number        = std::decay_t<decltype(point.mass())>;
        auto              b = push_forward(point.grad_v_dt(), elastic_part(point));
        const EigenSystem system(b);
        Number            strain[3], tau[3], volumetric = 0., squares = 0.;
        for (unsigned int a = 0; a < 3; ++a)
        {
          strain[a] = 0.5 * log(1. + system.value[a]);
          volumetric += strain[a];
        }
        for (Number &e : strain)
        {
          e -= volumetric / 3.;
          squares += e * e;
        }
        const Number old = point.state(plastic_strain), strength = law.strength(old), q = 2. * G * sqrt(1.5 * squares);
        const auto   yields = q > strength;
        Number       share  = 1.;
        if (any(yields))
        {
          // Elastic lanes take part with x = 0.
          const Number x = select(yields, law.increment(max(q, strength), old, G), Number(0.));
          share -= 3. * G * x / select(yields, q, Number(1.));
          point.set_state(plastic_strain, old + x);
          Number stretch[3];
          for (unsigned int a = 0; a < 3; ++a)
            stretch[a] = exp(2. * (volumetric / 3. + share * strain[a])) - 1.;
          const auto returned = system.assemble(stretch);
          for (unsigned int c = 0; c < b.n_independent_components; ++c)
            b.access_raw_entry(c) = select(yields, returned.access_raw_entry(c), b.access_raw_entry(c));
        }
        set_elastic_part(point, b);
        const Number inverse_J = exp(-volumetric);
        for (unsigned int a = 0; a < 3; ++a)
          tau[a] = inverse_J * (K * volumetric + 2. * G * share * strain[a]);
        point.set_stress(system.assemble(tau));
      });
    }
  } // namespace

  std::vector<std::string> Hencky::state_names() const
  {
    std::vector<std::string> names = VonMises::state_names();
    for (const std::string component : {"xx", "yy", "zz", "xy", "xz", "yz"})
      names.push_back("elastic strain " + component);
    return names;
  }

  void Hencky::update(const MaterialRange &range) const
  {
    with_hardening([&](const auto &law) { logarithmic_return(range, bulk_modulus(), shear_modulus(), law); });
  }

  void Hencky::wave_speeds(const MaterialRange &range, double *speeds) const
  {
    evaluate_points(range, speeds, [M = bulk_modulus() + 4. / 3. * shear_modulus()](const auto &point) {
      using Number      = std::decay_t<decltype(point.mass())>;
      const auto stress = point.stress();
      // Gershgorin: no principal stress is less than - the largest sum of a row.
      Number largest = 0.;
      for (unsigned int i = 0; i < 3; ++i)
        largest = max(largest, Number(-stress[i][i] + abs(stress[i][(i + 1) % 3]) + abs(stress[i][(i + 2) % 3])));
      return sqrt((M / volume_ratio(point) + largest) * point.specific_volume());
    });
  }

  void Hencky::strain_energy_densities(const MaterialRange &range, double *densities) const
  {
    evaluate_points(range, densities, [K = bulk_modulus(), G = shear_modulus()](const auto &point) {
      const auto stress   = point.stress();
      const auto s        = deviator(stress);
      const auto pressure = trace(stress) / 3.;
      // Of the stress times J, over J.
      return volume_ratio(point) * (pressure * pressure / (2. * K) + (s * s) / (4. * G));
    });
  }

  void Hencky::plastic_work_densities(const MaterialRange &range, double *densities) const
  {
    // The flow keeps the volume: the work is that of the stress times J.
    with_hardening([&](const auto &law) {
      evaluate_points(range, densities,
                      [law](const auto &point) { return law.work(point.state(plastic_strain)) / volume_ratio(point); });
    });
  }

  namespace
  {
    /** The volumetric strain theta of a mean stress: mean / K = theta exp(-theta), which has a greatest value 1/e. */
    double volumetric_strain(const double ratio)
    {
      double theta = std::min(ratio, 0.5);
      for (unsigned int i = 0; i < 60; ++i)
        theta -= (theta * std::exp(-theta) - ratio) / ((1 - theta) * std::exp(-theta));
      return theta;
    }
  } // namespace

  std::string Hencky::refusal(const std::array<double, 6> &stress) const
  {
    if ((stress[0] + stress[1] + stress[2]) / 3 < 0.3 * bulk_modulus())
      return "";
    return "its mean tension is more than 0.3 times the bulk modulus, which no volume of a logarithmic law bears. "
           "Lower it, or raise Young's modulus.";
  }

  std::vector<double> Hencky::initial_states(const std::array<double, 6> &stress) const
  {
    SymmetricTensor<2, 3> sigma;
    for (unsigned int c = 0; c < 6; ++c)
      sigma.access_raw_entry(c) = stress[c];
    const double              theta = volumetric_strain(trace(sigma) / 3 / bulk_modulus());
    const EigenSystem<double> system(deviator(sigma));
    double                    stretch[3];
    for (unsigned int a = 0; a < 3; ++a)
      stretch[a] = 0.5 * std::expm1(2 * (theta / 3 + std::exp(theta) * system.value[a] / (2 * shear_modulus())));
    std::vector<double> states(elastic_strain + 6, 0.);
    const auto          strain = system.assemble(stretch);
    for (unsigned int c = 0; c < 6; ++c)
      states[elastic_strain + c] = strain.access_raw_entry(c);
    return states;
  }

  namespace
  {
    const Register<Material, Hencky> registration("Hencky",
                                                  "finite strains, logarithmic; plastic as von Mises, softening");
  }
} // namespace Talus
