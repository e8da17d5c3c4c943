#include "point.h"

using namespace Test;

namespace
{
  constexpr double mu = 0.7, c = 5, rho = 3;

  SinglePoint point(const unsigned int dim = 3)
  {
    return SinglePoint("Newtonian fluid", set("Density", "3") + set("Viscosity", "0.7") + set("Sound speed", "5"), dim);
  }

  Tensor<2, 3> pressure(const double p) { return -p * Tensor<2, 3>(unit_symmetric_tensor<3>()); }
} // namespace

namespace newtonian_fluid
{
  /** The stress is p = c^2 (m/V - rho_ref) in compression and in tension, and what the rate adds, Eq. (69). */
  void uniaxial_strain()
  {
    for (unsigned int axis = 0; axis < 3; ++axis)
      for (const double rate : {0.3, -0.3})
      {
        auto         p = point();
        Tensor<2, 3> L;
        L[axis][axis] = rate;
        p.mass        = 3;
        double error  = 0;
        for (unsigned int n = 0; n < 10; ++n)
        {
          p.advance(L, 0.01);
          const double J = std::pow(1 + 0.01 * rate, n + 1);
          for (unsigned int d = 0; d < 3; ++d)
            raise(error, p.stress()[d][d] - (-c * c * (rho / J - rho) + (d == axis ? 4. / 3. : -2. / 3.) * mu * rate));
        }
        check("axis " + std::to_string(axis), error, 1e-12);
      }
  }

  /** v_x = g y: sigma_xy = mu g, and nothing else as volume stays. */
  void simple_shear()
  {
    for (const unsigned int dim : {2, 3})
    {
      auto         p = point(dim);
      Tensor<2, 3> L, expected;
      L[0][1]        = 0.8;
      expected[0][1] = expected[1][0] = mu * 0.8;
      p.mass                          = 3;
      for (unsigned int n = 0; n < 5; ++n)
        p.advance(L, 0.01);
      check(std::to_string(dim) + "D", distance(p.stress(), expected), 1e-13);
    }
  }

  /** Whatever the stress was, whatever has happened, and however long the step: density and rate decide. */
  void no_memory()
  {
    auto p = point(), q = point();
    p.mass = q.mass = 3;
    p.set_stress(some_tensor(1) + transpose(some_tensor(1)));
    p.advance(some_tensor(2), 0.01);
    p.volume = q.volume = 0.9;
    p.set_F(some_tensor(4));
    const Tensor<2, 3> L = deviatoric(some_tensor(5));
    p.advance(L, 1e-9);
    q.advance(L, 1e-8);
    check("stress", distance(p.stress(), q.stress()), 1e-13);
    check("pressure", trace(p.stress()) / 3 + c * c * (3 / 0.9 - 3), 1e-12);
    q.advance(Tensor<2, 3>(), 0.);
    check("at rest, in no time", distance(q.stress(), pressure(c * c * (3 / q.volume - 3))), 1e-13);
  }

  void plane_strain()
  {
    auto p = point(2), q = point(3);
    for (unsigned int n = 0; n < 10; ++n)
    {
      const Tensor<2, 3> L = some_tensor(0.2 * n, 2);
      p.advance(L, 1e-2);
      q.advance(L, 1e-2);
    }
    check("2D and 3D", distance(p.stress(), q.stress()), 1e-13);
    check_true("sigma_zz", std::abs(p.stress()[2][2]) > 0.1);
  }

  /** The energy of a particle is what compression from rho_ref has cost: -int p dV, by Simpson's rule. */
  void energy()
  {
    for (const double end : {0.8, 1.3})
    {
      auto p                  = point();
      p.mass                  = 3; // volume 1 at rho_ref
      double             work = 0;
      const unsigned int n    = 200;
      for (unsigned int i = 0; i <= n; ++i)
      {
        const double V      = 1 + (end - 1) * i / n;
        const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
        work -= weight * c * c * (3 / V - 3) * (end - 1) / (3 * n);
      }
      p.volume = end;
      check("volume " + std::to_string(end), p.strain_energy_density() * end - work, 1e-9);
      check_true("positive", work > 0.1);
    }
    auto p = point();
    p.mass = 3;
    check("none at rest", p.strain_energy_density(), 1e-14);
  }

  void numbers()
  {
    auto p   = point();
    p.volume = 0.7;
    check("wave speed, expanded", p.wave_speed() - c * std::sqrt(rho * 0.7), 1e-14); // m = 1
    p.volume = 0.3;
    check("wave speed, compressed", p.wave_speed() - c, 0.);
    p.volume = 0.7;
    check("rest stress ratio", p.material->rest_stress_ratio() - 1, 0.);
    check("kinematic viscosity", p.material->kinematic_viscosity() - mu / rho, 1e-15);
    p.mass = p.material->initial_density(10.) * p.volume;
    p.advance(Tensor<2, 3>(), 1.);
    check("initial density gives the initial pressure", distance(p.stress(), pressure(10)), 1e-13);
    SinglePoint solid("linear elastic", "", 3);
    check("a solid's density is as given", solid.material->initial_density(10.) - 1000, 0.);
    check("a solid has no viscosity", solid.material->kinematic_viscosity(), 0.);
  }

  void parameter_errors()
  {
    const auto error = [](const std::string &entry, const std::string &value, const std::string &remedy) {
      check_error<EntryError>(entry + " = " + value, {"/Materials/m: " + entry, remedy},
                              [&] { SinglePoint("Newtonian fluid", set(entry, value), 3); });
    };
    error("Viscosity", "-1", "must not be negative");
    error("Sound speed", "0", "ten times the greatest velocity");
    error("Density", "-1", "must be positive");
    const auto refusal = [](const std::array<double, 6> &stress) { return point().material->refusal(stress); };
    check_true("starts with pressure", refusal({{-7, -7, -7, 0, 0, 0}}).empty() && refusal({}).empty());
    check_true("not with a deviator", refusal({{-7, -7, -6, 0, 0, 0}}).find("hydrostatic") != std::string::npos);
    check_true("not with shear", refusal({{-7, -7, -7, 0, 0, 1}}).find("no shear") != std::string::npos);
    check_error<EntryError>("too much tension", {"/Materials/m: Sound speed", "-75", "Raise the sound speed"},
                            [] { point().material->initial_density(-75.); });
  }
} // namespace newtonian_fluid
