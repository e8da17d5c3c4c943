#include <talus/steppers/explicit_step.h>

#include "transfer.h"

using namespace Test;
using namespace dealii;

/** Smoothing of J of a fluid, in all cells of a box with walls, edges and corners, whatever the treatment there. */
namespace
{
  constexpr double c = 3, reference = 2, beta = 0.1;

  template <int dim>
  std::string fluid(const std::string &kernel, const std::string &treatment, const std::string &more)
  {
    const std::array<int, 3> cells = {{dim == 2 ? 6 : 4, dim == 2 ? 5 : 4, 4}};
    return skewed_grid<dim>(cells) + kernel_text(kernel, treatment) + walls_text<dim>("slip") +
           section("Materials",
                   set("Names", "water") + section("water", set("Type", "Newtonian fluid") + set("Density", "2") +
                                                              set("Sound speed", "3") + set("Viscosity", "0") + more)) +
           section("Bodies", set("Names", "body") +
                               section("body", set("Lower corner", coordinates<dim>({{-0.3, 0.7, 0.2}})) +
                                                 set("Upper corner",
                                                     coordinates<dim>({{-0.3 + 0.1 * cells[0], 0.7 + 0.08 * cells[1],
                                                                        0.2 + 0.125 * cells[2]}})) +
                                                 set("Jitter", "0.5")));
  }

  const std::string smoothed = set("J smoothing", "0.1");

  template <int dim>
  double J(const Setup<dim> &setup, const unsigned int p)
  {
    const auto &particles = setup.particles;
    return reference * particles.component(particles.volume, 0)[p] / particles.component(particles.mass, 0)[p];
  }

  /** J = function(particle), with masses of its own. */
  template <int dim, class Function>
  void set_J(Setup<dim> &setup, const Function &function)
  {
    auto &particles = setup.particles;
    setup.fill(particles.mass, [&](const unsigned int p, unsigned int) {
      return particles.component(particles.mass, 0)[p] * (1 + 0.3 * hashed_jitter(7, particles.id[p], 0));
    });
    setup.fill(particles.volume, [&](const unsigned int p, unsigned int) {
      return function(p) * particles.component(particles.mass, 0)[p] / reference;
    });
  }

  template <int dim>
  Tensor<1, dim> slope()
  {
    Tensor<1, dim> g;
    for (unsigned int d = 0; d < dim; ++d)
      g[d] = 0.2 - 0.15 * d;
    return g;
  }

  template <int dim>
  class SmoothedFluid : public Setup<dim>
  {
  public:
    SmoothedFluid(const std::string &kernel, const std::string &treatment) :
      Setup<dim>(fluid<dim>(kernel, treatment, smoothed)), name(kernel + ", " + treatment),
      h(this->grid.lattice.smallest_spacing())
    {
      while (particles.fields[gradient].name != "gradient of the smoothed volume ratio")
        ++gradient;
    }

    /** The grid's fields, which output shows, are left alone. */
    void check_grid()
    {
      double     touched = 0;
      auto      &fields  = this->grid.fields;
      const auto pattern = [](const unsigned int i, const unsigned int lane) { return 1. + i + 0.1 * lane; };
      for (unsigned int i = 0; i < fields.n_local(); ++i)
        for (unsigned int lane = 0; lane < fields.stride; ++lane)
          fields[i][lane] = pattern(i, lane);
      apply(h / c);
      for (unsigned int i = 0; i < fields.n_local(); ++i)
        for (unsigned int lane = 0; lane < fields.stride; ++lane)
          raise(touched, fields[i][lane] - pattern(i, lane));
      check(name + ": fields of the grid", touched, 1e-300);
    }

    /** A linear J with its gradient stays, and the gradient too. */
    void check_linear()
    {
      const auto linear = [&](const unsigned int p) { return 1 + slope<dim>() * this->position(p); };
      set_J(*this, linear);
      this->fill(gradient, [](unsigned int, const unsigned int d) { return slope<dim>()[d]; });
      for (unsigned int n = 0; n < 20; ++n)
        apply(h / c); // alpha = beta
      double error = 0, slope_error = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        raise(error, J(*this, p) - linear(p));
        for (unsigned int d = 0; d < dim; ++d)
          raise(slope_error, h * (particles.component(gradient, d)[p] - slope<dim>()[d]));
      }
      check(name + ": linear J", error, 1e-12);
      check(name + ": its gradient", slope_error, 1e-12);
    }

    /** A random one: the sum of m J stays, F and stress follow the volume, and alpha of the difference goes. */
    void check_random()
    {
      set_random_J();
      this->randomize(gradient, 10);
      const double before = total();
      const auto   first  = all_J();
      apply(h / c); // alpha = 0.1
      const auto small     = all_J();
      double     det_error = 0, stress_error = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        raise(det_error, determinant(matrix(*this, particles.F, p)) - small[p]);
        raise(stress_error, particles.component(particles.stress, 1)[p] + c * c * reference * (1 / small[p] - 1));
      }
      check(name + ": sum of m J", total() / before - 1, 1e-13);
      check(name + ": det F", det_error, 1e-13);
      check(name + ": stress", stress_error, 1e-12);
      check_alpha(first, small);
    }

    void check_noise()
    {
      set_random_J();
      this->smoothing.initialize(this->materials, *this->kernel, particles, this->grid);
      const double rough = roughness();
      for (unsigned int n = 0; n < 100; ++n)
        apply(h / c);
      check(name + ": what is left of noise", std::sqrt(roughness() / rough), 0.8);
    }

  private:
    using Setup<dim>::particles;

    void apply(const double dt) { this->smoothing.apply(this->materials, *this->kernel, dt, particles, this->grid); }

    /** The same from the same state in a step ten times as long, and in one beyond the limit: alpha = 1. */
    void check_alpha(const std::vector<double> &first, const std::vector<double> &small)
    {
      const auto again = [&](const double dt) {
        this->fill(particles.volume, [&](const unsigned int p, unsigned int) {
          return first[p] * particles.component(particles.mass, 0)[p] / reference;
        });
        this->randomize(gradient, 10);
        apply(dt);
        return all_J();
      };
      const auto tenfold = again(10 * h / c), beyond = again(1000 * h / c);
      double     alpha_error = 0, limit_error = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        raise(alpha_error, (small[p] - first[p]) - 0.1 * (tenfold[p] - first[p]));
        raise(limit_error, beyond[p] - tenfold[p]);
      }
      check(name + ": alpha", alpha_error, 1e-13);
      check(name + ": alpha <= 1", limit_error, 1e-13);
    }

    void set_random_J()
    {
      set_J(*this, [&](const unsigned int p) { return 1 + 0.1 * hashed_jitter(9, particles.id[p], 0); });
    }

    std::vector<double> all_J() const
    {
      std::vector<double> values;
      for (unsigned int p = 0; p < particles.size(); ++p)
        values.push_back(J(*this, p));
      return values;
    }

    double total() const
    {
      double result = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
        result += particles.component(particles.mass, 0)[p] * J(*this, p);
      return sum(result);
    }

    double roughness() const
    {
      double result = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
        result += std::pow(J(*this, p) - 1, 2);
      return sum(result);
    }

    const std::string name;
    const double      h;
    unsigned int      gradient = 0;
  };
} // namespace

template <int dim>
void smoothing()
{
  for (const std::string kernel : {"linear", "quadratic B-spline", "cubic B-spline", "uGIMP"})
    for (const std::string treatment : {"none", "WLS", "mirror"})
    {
      SmoothedFluid<dim> setup(kernel, treatment);
      setup.check_grid();
      setup.check_linear();
      setup.check_random();
      setup.check_noise();
    }

  Setup<dim> off(fluid<dim>("quadratic B-spline", "WLS", ""));
  for (const auto &field : off.particles.fields)
    check_true("off: no field " + field.name, field.name.find("gradient of the smoothed") == std::string::npos);
  check_error<EntryError>("negative", {"J smoothing", "must not be negative"},
                          [] { Setup<dim> bad(fluid<dim>("quadratic B-spline", "WLS", set("J smoothing", "-1"))); });
}

template void smoothing<2>();
template void smoothing<3>();
