#include <talus/simulation/element_control.h>

#include <deal.II/lac/full_matrix.h>

#include <cmath>
#include <limits>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  const std::array<const char *, 6> component_names_of_stress{{"xx", "yy", "zz", "xy", "xz", "yz"}};

  namespace
  {
    constexpr double       largest_strain = 0.9;   // of held components in a step: 1 leaves nothing of a length
    constexpr double       tolerance      = 1e-11; // of the stress
    constexpr unsigned int max_iterations = 60;
    // Beside the greatest entry of the Jacobian: what is softer than this counts as a stress that can not change.
    constexpr double softest = 1e-6;

    double largest(const Tensor<2, 3> &tensor)
    {
      double most = 0;
      for (unsigned int c = 0; c < 9; ++c)
        most = std::max(most, std::abs(tensor[c / 3][c % 3]));
      return most;
    }

    double largest(const std::vector<double> &values)
    {
      double most = 0;
      for (const double value : values)
        most = std::max(most, std::abs(value));
      return most;
    }

    double largest_stress(const ElementPoint &point)
    {
      return largest(std::vector<double>(point.stress.begin(), point.stress.end()));
    }

    /** The two places of a component in a tensor. */
    void add(Tensor<2, 3> &tensor, const unsigned int component, const double value)
    {
      const auto ij = SymmetricTensor<2, 3>::unrolled_to_component_indices(component);
      tensor[ij[0]][ij[1]] += value;
      if (ij[0] != ij[1])
        tensor[ij[1]][ij[0]] += value;
    }
  } // namespace

  ElementControl::Trial ElementControl::attempt(const ElementPoint &start, const ElementStep &step,
                                                const std::vector<double> &x) const
  {
    Trial        trial{start, std::vector<double>(x.size()), 0};
    Tensor<2, 3> increment = step.driven;
    for (unsigned int k = 0; k < x.size(); ++k)
      add(increment, step.held[k], x[k]);
    trial.point.advance(increment, step.dt);
    double squares = 0;
    for (unsigned int k = 0; k < x.size(); ++k)
    {
      trial.rest[k] = trial.point.stress[step.held[k]] - step.target[step.held[k]];
      squares += trial.rest[k] * trial.rest[k];
    }
    trial.size = trial.point.is_sound() && largest(x) < largest_strain ? std::sqrt(squares) :
                                                                         std::numeric_limits<double>::infinity();
    return trial;
  }

  std::vector<double> ElementControl::correction(const ElementPoint &start, const ElementStep &step,
                                                 const std::vector<double> &x, const Trial &now,
                                                 const double size) const
  {
    const unsigned int n = x.size();
    const double       h = 1e-5 * size + 1e-9 * largest_stress(now.point) / start.stiffness();
    FullMatrix<double> J(n, n);
    double             greatest = 0;
    for (unsigned int k = 0; k < n; ++k)
    {
      auto beside = x;
      beside[k] += h;
      const Trial other = attempt(start, step, beside);
      for (unsigned int i = 0; i < n; ++i)
      {
        J(i, k)  = (other.rest[i] - now.rest[i]) / h;
        greatest = std::max(greatest, std::abs(J(i, k)));
      }
    }
    std::vector<double> change(n, 0.);
    if (!(greatest > 0 && std::isfinite(greatest)))
      return change;
    FullMatrix<double> normal(n, n);
    J.Tmmult(normal, J);
    for (unsigned int k = 0; k < n; ++k)
      normal(k, k) += softest * softest * greatest * greatest;
    normal.gauss_jordan();
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j < n; ++j)
          change[k] -= normal(k, i) * J(j, i) * now.rest[j];
    return change;
  }

  bool ElementControl::search(const ElementPoint &start, const ElementStep &step, const std::vector<double> &change,
                              std::vector<double> &x, Trial &now) const
  {
    double share = 1;
    for (unsigned int halving = 0; halving < 12; ++halving, share /= 2)
    {
      auto next = x;
      for (unsigned int k = 0; k < x.size(); ++k)
        next[k] += share * change[k];
      Trial trial = attempt(start, step, next);
      if (trial.size < now.size)
      {
        x   = next;
        now = trial;
        return true;
      }
    }
    return false;
  }

  bool ElementControl::converge(const ElementPoint &start, const ElementStep &step, std::vector<double> &x,
                                Trial &now) const
  {
    const double modulus = start.stiffness();
    const auto   bound   = [&] {
      return tolerance * std::max(largest_stress(now.point), modulus * std::max(largest(step.driven), largest(x)));
    };
    now = attempt(start, step, x);
    for (unsigned int i = 0; i < max_iterations && now.size > bound(); ++i)
    {
      const double size = std::max({largest(step.driven), largest(x), now.size / modulus});
      if (std::isinf(now.size) || !search(start, step, correction(start, step, x, now, size), x, now))
        return false;
    }
    return now.size <= bound();
  }

  bool ElementControl::creep(const ElementPoint &start, const ElementStep &step, const unsigned int n_parts,
                             std::vector<double> &x, Trial &now) const
  {
    x.assign(step.held.size(), 0.);
    for (unsigned int part = 1; part <= n_parts; ++part)
    {
      const double share = static_cast<double>(part) / n_parts;
      ElementStep  small = step;
      small.driven *= share;
      small.dt *= share;
      for (const unsigned int c : step.held)
        small.target[c] = start.stress[c] + share * (step.target[c] - start.stress[c]);
      for (double &strain : x)
        strain *= part > 1 ? part / (part - 1.) : 1.;
      if (!converge(start, small, x, now))
        return false;
    }
    return true;
  }

  std::string ElementControl::advance(ElementPoint &point, const ElementStep &step)
  {
    const unsigned int n = step.held.size();
    strains.resize(n, 0.);
    auto  x = strains;
    Trial now{point, {}, 0};
    bool  is_met = converge(point, step, x, now);
    // Stresses that differ a little flow on a face, far in strain from the edge beside it, where they can not differ.
    double       left = now.size;
    const double size = std::max(largest(step.driven), largest(strains));
    for (const double far : {0., 1., -1., 3., -3., 10., -10.})
      for (unsigned int k = 0; k < n && !is_met; ++k)
      {
        x.assign(n, 0.);
        x[k]   = far * size;
        is_met = converge(point, step, x, now);
        left   = std::min(left, now.size);
      }
    // At an apex no stress changes at all: it is not to be met on the way.
    for (const unsigned int n_parts : {8, 64, 512})
      is_met = is_met || creep(point, step, n_parts, x, now);
    if (is_met)
    {
      strains = x;
      point   = now.point;
      return "";
    }
    if (std::isinf(left))
      return "it turns the point inside out, or the stress is no number. Raise 'Steps', or lower the strain.";
    std::ostringstream text;
    text << "no strain gives the stresses that are asked for, by " << left
         << ". Raise 'Steps'; if that does not help, the material has no strength for them, and the path ends before.";
    return text.str();
  }
} // namespace Talus
