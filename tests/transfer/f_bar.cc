#include <talus/steppers/deformation.h>

#include <map>

#include "some_box.h"

using namespace Test;
using namespace dealii;

namespace
{
  /** Sums of all ranks at nodes, which their places tell apart: mass, and mass times a number. */
  template <int dim>
  class NodeMeans
  {
  public:
    void add(const Setup<dim> &setup, const unsigned int p, const double value)
    {
      const auto stencil = setup.stencil(p);
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        auto &[m, sum] = sums[key(setup.position(p), stencil, k)];
        m += stencil.weight[k] * mass_of(setup, p);
        sum += stencil.weight[k] * mass_of(setup, p) * value;
      }
    }
    void collect()
    {
      const auto all = Utilities::MPI::all_gather(MPI_COMM_WORLD, sums);
      sums.clear();
      for (const auto &part : all)
        for (const auto &[k, value] : part)
        {
          sums[k].first += value.first;
          sums[k].second += value.second;
        }
    }
    double at(const Setup<dim> &setup, const unsigned int p) const
    {
      const auto stencil = setup.stencil(p);
      double     value = 0, weight = 0;
      for (unsigned int k = 0; k < stencil.size; ++k)
      {
        const auto &[m, sum] = sums.at(key(setup.position(p), stencil, k));
        value += m > 0 ? stencil.weight[k] * sum / m : 0;
        weight += stencil.weight[k];
      }
      return value / weight;
    }

  private:
    using Key = std::array<long, dim>;
    static Key key(const Point<dim> &x, const Stencil<dim> &stencil, const unsigned int k)
    {
      Key result;
      for (unsigned int d = 0; d < dim; ++d)
        result[d] = std::lround(1e4 * (x[d] + stencil.offset[d][k]));
      return result;
    }
    std::map<Key, std::pair<double, double>> sums;
  };

  /** F-bar of the particles of a box, whose kernel is not corrected: its lists are those of the definition. */
  template <int dim>
  class FBarSetup : public Setup<dim>
  {
  public:
    explicit FBarSetup(const std::string &name) :
      Setup<dim>(some_box<dim>(name, section("Run", set("F-bar", "true")) +
                                       (name == "CPDI" ? "" : section("Kernel", set("Boundary treatment", "none"))))),
      name(name), seen(seen_gradient(particles))
    {
    }

    void check_uniform_change()
    {
      check_true(name + ": materials see another gradient",
                 material_range(particles, 0, dt).grad_v[0] == particles.component(seen, 0) &&
                   seen != particles.grad_v);
      double error = 0;
      this->fill(particles.grad_v, [&](const unsigned int, const unsigned int c) { return 1. + c; });
      f_bar.start(1, *this->kernel, particles, this->grid);
      f_bar.average_rate(dt, particles, this->grid);
      for (unsigned int p = 0; p < particles.size(); ++p)
        raise(error, dt * (particles.matrix(seen, p) - particles.matrix(particles.grad_v, p)).norm());
      check(name + ": a uniform change stays", error, 1e-13);
    }

    void check_deformation()
    {
      this->randomize(particles.grad_v, 11);
      std::vector<double> change(particles.size());
      for (unsigned int p = 0; p < particles.size(); ++p)
        change[p] = std::log(determinant(deformation(particles.grad_v, p)));
      const auto mean = average(change);
      f_bar.start(1, *this->kernel, particles, this->grid);
      const auto x = particles.vector(particles.position, 0);
      shift(1e-3); // particles have moved; the weights are those from before
      f_bar.average_rate(dt, particles, this->grid);
      shift(-1e-3);
      check(name + ": positions", (particles.vector(particles.position, 0) - x).norm(), 1e-15);
      double error = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
        raise(error,
              (deformation(seen, p) - std::exp((mean[p] - change[p]) / dim) * deformation(particles.grad_v, p)).norm());
      check(name + ": f-bar", error, 1e-13);
    }

    void check_stress()
    {
      this->randomize(particles.stress, 12);
      const auto          columns = particles.template components<WorkingSet<dim>::n_stress>(particles.stress);
      const double       *V       = particles.component(particles.volume, 0);
      std::vector<double> own(particles.size()), other(particles.size());
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        for (unsigned int d = 0; d < dim; ++d)
          own[p] += columns[d][p] / dim;
        other[p] = hashed_jitter(5, particles.id[p], 0);
      }
      std::vector<std::vector<double>> before;
      for (const double *column : columns)
        before.emplace_back(column, column + particles.size());
      f_bar.average_stress(particles, this->grid);
      // The adjoint: whatever the numbers a, sum V p-of-the-nodes a = sum V p (A A a).
      const auto averaged = average(other);
      double     left = 0, right = 0, size = 0, shear = 0, back = 0;
      for (unsigned int p = 0; p < particles.size(); ++p)
      {
        const double added = columns[0][p] - before[0][p];
        left += V[p] * (own[p] + added) * other[p];
        right += V[p] * own[p] * averaged[p];
        size += std::abs(V[p] * own[p]);
        for (unsigned int c = 0; c < columns.size(); ++c)
          raise(shear, columns[c][p] - before[c][p] - (c < 3 ? added : 0.));
      }
      check(name + ": stress is the adjoint", sum(left - right) / sum(size), 1e-13);
      check(name + ": only the mean changes", max(shear), 1e-14);
      f_bar.remove_added(particles, 0, particles.size());
      for (unsigned int c = 0; c < columns.size(); ++c)
        for (unsigned int p = 0; p < particles.size(); ++p)
          raise(back, columns[c][p] - before[c][p]);
      check(name + ": the law's own stress", max(back), 1e-14);
    }

  private:
    using Setup<dim>::particles;
    using Setup<dim>::f_bar;

    /** Twice over the nodes. */
    std::vector<double> average(std::vector<double> a) const
    {
      for (unsigned int n = 0; n < 2; ++n)
      {
        NodeMeans<dim> means;
        for (unsigned int p = 0; p < a.size(); ++p)
          means.add(*this, p, a[p]);
        means.collect();
        for (unsigned int p = 0; p < a.size(); ++p)
          a[p] = means.at(*this, p);
      }
      return a;
    }

    Tensor<2, dim> deformation(const unsigned int field, const unsigned int p) const
    {
      Tensor<2, dim> f = dt * particles.matrix(field, p);
      for (unsigned int d = 0; d < dim; ++d)
        f[d][d] += 1;
      return f;
    }

    void shift(const double distance)
    {
      for (unsigned int d = 0; d < dim; ++d)
        for (unsigned int p = 0; p < particles.size(); ++p)
          particles.component(particles.position, d)[p] += distance;
    }

    static constexpr double dt = 1e-2;
    const std::string       name;
    const unsigned int      seen;
  };
} // namespace

/**
 * F-bar against its definition, with averages summed here over lists: particles deform by f-bar, f but for its volume,
 * which is that of ln j averaged twice; the mean stress that the nodes get is the adjoint of that; a step of the law
 * sees its own stress. Weights are those of the start of the step.
 */
template <int dim>
void f_bar()
{
  for (const auto &kernel : all_kernels)
  {
    FBarSetup<dim> setup(kernel);
    setup.check_uniform_change();
    setup.check_deformation();
    setup.check_stress();
  }
  check_error<EntryError>("with smoothing", {"/Run: F-bar", "'J smoothing' of 'rubber'"}, [] {
    Setup<dim> bad(skewed_grid<dim>({{4, 4, 4}}) + section("Run", set("F-bar", "true")) +
                   section("Materials", section("rubber", set("Type", "Newtonian fluid") + set("J smoothing", ".1"))) +
                   section("Materials", set("Names", "rubber")));
  });
}

template void f_bar<2>();
template void f_bar<3>();
