#include "point.h"

using namespace Test;

/** Hencky's law: closed forms in logarithmic strains, which add up along coaxial paths whatever the steps. */
namespace hencky
{
  namespace
  {
    constexpr double E = 700, nu = 0.2, K = E / (3 * (1 - 2 * nu)), G = E / (2 * (1 + nu));
    constexpr double peak = 30, residual = 10, eta = 20;

    const Tensor<2, 3> I(unit_symmetric_tensor<3>());

    const std::string elastic = set("Young's modulus", "700") + set("Poisson's ratio", "0.2");
    const std::string clay    = elastic + set("Yield stress", "30") + set("Hardening", "exponential softening") +
                             set("Residual yield stress", "10") + set("Softening rate", "20");

    SinglePoint rubber(const unsigned int dim = 3)
    {
      return SinglePoint("Hencky", elastic + set("Yield stress", "1e6"), dim);
    }
    SinglePoint soft(const unsigned int dim = 3) { return SinglePoint("Hencky", clay, dim); }

    double strength(const double strain) { return residual + (peak - residual) * std::exp(-eta * strain); }

    /** A step that takes F to f F. */
    void step(SinglePoint &p, const Tensor<2, 3> &f) { p.advance(f - I, 1.); }

    /** Stretches by `ratio` along an axis. */
    Tensor<2, 3> stretch(const unsigned int axis, const double ratio)
    {
      Tensor<2, 3> f = I;
      f[axis][axis]  = ratio;
      return f;
    }

    double trial(const double e, const double strain) { return 2 * G * e - 3 * G * strain; }
  } // namespace

  /**
   * Strain e = ln a along an axis: J sigma = K e I + s with the von Mises stress q = 2 G e, or of 2 G e - 3 G x =
   * sigma_Y(x); then back until it yields the other way.
   */
  void uniaxial_strain()
  {
    for (const bool is_plastic : {false, true})
      for (unsigned int axis = 0; axis < 3; ++axis)
      {
        auto       p = is_plastic ? soft() : rubber();
        double     e = 0, error = 0, q = 0;
        const auto go = [&](const double ratio) {
          step(p, stretch(axis, ratio));
          e += std::log(ratio);
          const double J = std::exp(e);
          q              = 1.5 * (J * p.stress()[axis][axis] - K * e);
          for (unsigned int d = 0; d < 3; ++d)
            raise(error, J * p.stress()[d][d] - (K * e + (d == axis ? 2 : -1) * q / 3));
          raise(error, J * (p.stress() - diagonal(p.stress()[0][0], p.stress()[1][1], p.stress()[2][2])).norm());
        };
        for (unsigned int n = 0; n < 30; ++n)
        {
          go(1.02);
          raise(error, q - trial(e, p.states[0]));
          if (is_plastic && 2 * G * e > peak)
            raise(error, q - strength(p.states[0]));
          else
            raise(error, p.states[0]);
        }
        const double top = q;
        go(0.999);
        raise(error, q - (top + 2 * G * std::log(0.999))); // elastic when it turns
        for (unsigned int n = 0; n < 30; ++n)
          go(0.97);
        raise(error, q + (is_plastic ? strength(p.states[0]) : -2 * G * e));
        check(std::string(is_plastic ? "plastic" : "elastic") + ", axis " + std::to_string(axis), error, 1e-11);
      }
  }

  /** F_xy = g in one step or in many, which do not turn alike but end with the same b: the closed form of ln b. */
  void simple_shear()
  {
    for (const unsigned int dim : {2, 3})
      for (const unsigned int N : {1, 7})
      {
        const double g = 1.6, e = std::asinh(g / 2), root = std::sqrt(4 + g * g);
        auto         p = rubber(dim);
        Tensor<2, 3> f = I, expected;
        f[0][1]        = g / N;
        for (unsigned int n = 0; n < N; ++n)
          step(p, f);
        expected[0][1] = expected[1][0] = 2 * G * e * 2 / root;
        expected[0][0]                  = 2 * G * e * g / root;
        expected[1][1]                  = -expected[0][0];
        check(std::to_string(N) + " steps, " + std::to_string(dim) + "D", distance(p.stress(), expected), 1e-11);
        check("its energy", p.strain_energy_density() - 2 * G * e * e, 1e-11);
      }
  }

  /** diag(a, 1/a, 1): q = sqrt(3) 2 G ln a, no pressure, J = 1; with the strength as |s| sqrt(2/3) of it. */
  void isochoric()
  {
    for (const std::string norm : {"von Mises", "deviator"})
      for (const unsigned int dim : {2, 3})
      {
        const double scale = norm == "deviator" ? std::sqrt(1.5) : 1.;
        SinglePoint  p("Hencky", clay + set("Strength norm", norm), dim);
        double       e = 0, error = 0;
        for (unsigned int n = 0; n < 60; ++n)
        {
          step(p, diagonal(1.01, 1 / 1.01, 1));
          e += std::log(1.01);
          const double x = p.states[0], q = std::sqrt(3.) * 2 * G * e - 3 * G * x;
          raise(error, von_mises(p.stress()) - q);
          raise(error, trace(p.stress()));
          raise(error, p.stress()[2][2]);
          if (x > 0)
            raise(error, q - scale * strength(x));
          if (norm == "deviator" && x > 0)
            raise(error, deviatoric(p.stress()).norm() - strength(x));
        }
        check(norm + ", " + std::to_string(dim) + "D", error, 1e-11);
        check_true("has softened", p.states[0] > 0.3);
      }
  }

  /**
   * Wild paths: the yield function is never positive, and zero where the plastic strain grows; that never falls. The
   * plastic flow keeps the volume: J is that of F.
   */
  void return_map()
  {
    auto         p       = soft();
    double       outside = 0, off = 0, least = 0, volume = 0;
    unsigned int n_plastic = 0, n_elastic = 0;
    for (unsigned int n = 0; n < 400; ++n)
    {
      const double before = p.states[0];
      p.advance(some_tensor(0.37 * n), 0.05 * std::exp(-0.01 * n));
      const double J = determinant(p.deformation()), q = J * von_mises(p.stress()), x = p.states[0] - before;
      least   = std::min(least, x);
      outside = std::max(outside, q - strength(p.states[0]));
      if (x > 1e-14)
        raise(off, q - strength(p.states[0]));
      raise(volume, J * trace(p.stress()) / 3 - K * std::log(J));
      ++(x > 0 ? n_plastic : n_elastic);
    }
    check("outside the surface", outside, 1e-11);
    check("off the surface", off, 1e-11);
    check("plastic strain that goes back", least, 0.);
    check("J of F", volume, 1e-9);
    check_true("both kinds of steps", n_plastic > 20 && n_elastic > 20);
  }

  /**
   * The work of a path, J sigma : d by the rule of midpoints, is what the energy gains and sigma_Y dx dissipates: an
   * error of second order in the step, which falls to a quarter.
   */
  void energy()
  {
    for (const bool is_plastic : {false, true})
    {
      double before = 0;
      for (const unsigned int N : {2000, 4000})
      {
        auto         p    = is_plastic ? soft() : rubber();
        double       work = 0, dissipated = 0, size = 0;
        Tensor<2, 3> tau;
        for (unsigned int n = 0; n < N; ++n)
        {
          const double       t = (n + 0.5) / N, x = p.states[0];
          const Tensor<2, 3> L = 0.4 * std::cos(3 * t) * some_tensor(1) + 0.3 * some_tensor(2);
          // The midpoint rule of f = exp(L dt), so that steps have no error of first order.
          const Tensor<2, 3> f = invert(I - 0.5 / N * L) * (I + 0.5 / N * L);
          step(p, f);
          const Tensor<2, 3> next = determinant(p.deformation()) * p.stress();
          work += scalar_product(0.5 * (tau + next), L) / N;
          dissipated += 0.5 * (strength(x) + strength(p.states[0])) * (p.states[0] - x);
          size = std::max(size, std::abs(work));
          tau  = next;
        }
        const double error =
          work - determinant(p.deformation()) * p.strain_energy_density() - (is_plastic ? dissipated : 0.);
        const std::string name = is_plastic ? "plastic" : "elastic";
        check(name + ": work, energy and dissipation", error / size, is_plastic ? 1e-4 : 1e-6);
        if (is_plastic)
          check_true("something is dissipated", dissipated > 0.1 * size);
        else if (before != 0)
          check_range(name + ", second order: ratio", before / error, 3.9, 4.1);
        before = error;
      }
    }
  }

  /** f seen from a frame that turns by R_n, R_n+1 f R_n^T, gives R sigma R^T to round-off, in plastic flow too. */
  void objectivity()
  {
    for (const bool is_plastic : {false, true})
    {
      auto       p = is_plastic ? soft() : rubber(), q = is_plastic ? soft() : rubber();
      const auto R = [](const unsigned int n) { return rotation(0, 1, 0.3 * n) * rotation(1, 2, -0.2 * n); };
      for (unsigned int n = 0; n < 30; ++n)
      {
        const Tensor<2, 3> f = I + 0.03 * some_tensor(0.3 * n);
        step(p, f);
        step(q, R(n + 1) * f * transpose(R(n)));
      }
      const std::string name = is_plastic ? "plastic" : "elastic";
      check(name + ": stress", distance(R(30) * p.stress() * transpose(R(30)), q.stress()), 1e-11);
      check(name + ": plastic strain", p.states[0] - q.states[0], 1e-13);
      check_true(name + ": yields", is_plastic == (p.states[0] > 0.01));
    }
  }

  /** A body that starts with a stress keeps it, and answers from it as if it had been loaded to it. */
  void initial_stress()
  {
    auto p = rubber(), q = rubber();
    for (unsigned int n = 0; n < 5; ++n)
      step(p, I + 0.05 * some_tensor(n));
    q.set_stress(p.stress());
    step(q, I);
    check("stays", distance(p.stress(), q.stress()), 1e-11);
    const Tensor<2, 3> f = I + 0.1 * some_tensor(9);
    step(p, f);
    step(q, f);
    check("goes on alike", distance(p.stress(), q.stress()), 1e-11);
    check("has its energy", p.strain_energy_density() - q.strain_energy_density(), 1e-11);
    check_true("of some size", p.stress().norm() > 10);
    check_true("pressure", q.material->refusal({{-1e4, -1e4, -1e4, 0, 0, 0}}).empty());
    check_true("tension", q.material->refusal({{200, 200, 200, 0, 0, 0}}).find("Young's modulus") < 1000);
  }

  /** Waves along the axis of a stretch a, rho c^2 = a^2 W''(a) / J: the law's speed is an upper bound, sharp at rest.
   */
  void wave_speed()
  {
    const auto nominal = [](const double a, const double across) {
      auto p = rubber();
      step(p, diagonal(a, across, across));
      return across * across * p.stress()[0][0];
    };
    double least = 10;
    for (const double a : {0.7, 0.9, 1., 1.1})
      for (const double across : {0.9, 1., 1.1})
      {
        auto p = rubber();
        step(p, diagonal(a, across, across)); // of a mass per stress-free volume of 1
        const double d     = 1e-5 * a,
                     exact = std::sqrt(a * a * (nominal(a + d, across) - nominal(a - d, across)) / (2 * d));
        least              = std::min(least, p.wave_speed() / exact);
        if (a == 1 && across == 1)
          check("at rest", p.wave_speed() / std::sqrt(K + 4 * G / 3) - 1, 1e-14);
      }
    check_range("bound over speed", least, 1 - 1e-9, 1.001);
  }

  void plane_strain()
  {
    auto p = soft(2), q = soft(3);
    for (unsigned int n = 0; n < 40; ++n)
    {
      const Tensor<2, 3> L = some_tensor(0.2 * n, 2);
      p.advance(L, 0.03);
      q.advance(L, 0.03);
    }
    check("2D and 3D", distance(p.stress(), q.stress()) + std::abs(p.states[0] - q.states[0]), 1e-12);
    check_true("sigma_zz and plastic strain", std::abs(p.stress()[2][2]) > 0.1 && p.states[0] > 1e-2);
  }

  void parameter_errors()
  {
    const std::string softening = set("Hardening", "exponential softening") + set("Strength norm", "deviator");
    // 3 G / sqrt(3/2) = 3 * 1e6 / 2.6 / 1.2247 over 1000
    check_error<EntryError>("too fast", {"/Materials/m: Softening rate", "Lower it below 942.1"},
                            [&] { SinglePoint("Hencky", set("Softening rate", "943") + softening, 3); });
  }
} // namespace hencky
