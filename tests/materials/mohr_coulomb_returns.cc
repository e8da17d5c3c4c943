#include "mohr_coulomb.h"

#include <algorithm>

namespace mohr_coulomb
{
  namespace
  {
    /** The plastic strain that takes a trial stress to another: D^-1 of the difference, both diagonal. */
    Tensor<1, 3> plastic_strain(const Tensor<2, 3> &trial, const Tensor<2, 3> &stress)
    {
      const Tensor<2, 3> difference = trial - stress;
      Tensor<1, 3>       e;
      for (unsigned int i = 0; i < 3; ++i)
        e[i] = difference[i][i] / (2 * G) - lambda / (2 * G * (3 * lambda + 2 * G)) * trace(difference);
      return e;
    }

    /**
     * How far `e` is from the cone of the directions: the least residual over all subsets of up to three that take part
     * with factors that are not negative. An independent check of a return: it knows nothing of planes, edges and
     * points.
     */
    double distance_to_cone(const Tensor<1, 3> &e, const std::vector<Tensor<1, 3>> &directions)
    {
      double             least = e.norm();
      const unsigned int n     = directions.size();
      for (unsigned int set = 1; set < 1u << n; ++set)
      {
        std::vector<Tensor<1, 3>> basis;
        for (unsigned int i = 0; i < n; ++i)
          if (set >> i & 1)
            basis.push_back(directions[i]);
        if (basis.size() > 3)
          continue;
        // The normal equations, filled up to three by ones.
        Tensor<2, 3> A = unit_symmetric_tensor<3>();
        Tensor<1, 3> b;
        for (unsigned int i = 0; i < basis.size(); ++i)
        {
          for (unsigned int j = 0; j < basis.size(); ++j)
            A[i][j] = basis[i] * basis[j];
          b[i] = basis[i] * e;
        }
        if (std::abs(determinant(A)) < 1e-12)
          continue;
        const Tensor<1, 3> factor = invert(A) * b;
        Tensor<1, 3>       rest   = e;
        bool               is_in  = true;
        for (unsigned int i = 0; i < basis.size(); ++i)
        {
          rest -= factor[i] * basis[i];
          is_in = is_in && factor[i] > -1e-12;
        }
        if (is_in)
          least = std::min(least, rest.norm());
      }
      return least;
    }
  } // namespace

  /** All kinds of returns from wild trial stresses: on the surface, by a plastic strain of the active faces. */
  void returns()
  {
    for (const double phi : {0., 20., 40.})
      for (const double share : {0., 0.3, 1.})
        for (const std::string tension : {"-1", "0", "0.05", "0.4"})
        {
          double       outside = 0, flow = 0, states = 0;
          unsigned int n_active[4] = {};
          Soil         p(phi, share * phi, 0.5, set("Tension strength", tension));
          for (unsigned int n = 0; n < 1000; ++n)
          {
            p.states.fill(0.);
            const double size = 1 + 3 * std::abs(std::sin(0.11 * n));
            Tensor<2, 3> trial =
              diagonal(size * std::sin(2.3 * n), size * std::sin(5.1 * n + 1), size * std::sin(7.7 * n + 2)) +
              pressure(2 * std::sin(0.71 * n));
            if (n % 5 == 0) // on the edges too
              trial[1][1] = trial[0][0];
            p.set_stress(trial);
            p.advance(Tensor<2, 3>(), 1.);
            const double limit =
              std::min(std::stod(tension) < 0 ? 1e300 : std::stod(tension), p.s > 0 ? p.twice_c / (2 * p.s) : 1e300);
            std::vector<Tensor<1, 3>> directions;
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                if (i == j ? p.stress()[i][i] > limit - 1e-9 : p.face(i, j) > -1e-9)
                {
                  Tensor<1, 3> direction;
                  direction[i] = i == j ? 1. : 1 + p.d;
                  if (i != j)
                    direction[j] = -(1 - p.d);
                  directions.push_back(direction);
                }
            for (unsigned int i = 0; i < 3; ++i)
              for (unsigned int j = 0; j < 3; ++j)
                outside = std::max(outside, i == j ? p.stress()[i][i] - limit : p.face(i, j));
            const auto e = plastic_strain(trial, p.stress());
            flow         = std::max(flow, distance_to_cone(e, directions));
            raise(states, p.states[1] - (e[0] + e[1] + e[2]));
            raise(states, p.states[0] - std::sqrt(2. / 3.) * deviatoric(diagonal(e[0], e[1], e[2])).norm());
            ++n_active[std::min<std::size_t>(directions.size(), 3)];
          }
          const std::string name =
            "phi " + std::to_string(phi) + ", psi " + std::to_string(share * phi) + ", tension " + tension;
          check(name + ": outside", outside, 1e-13);
          check(name + ": flow", flow, 1e-13);
          check(name + ": states", states, 1e-14);
          check_true(name + ": inside, faces, edges and points",
                     n_active[0] > 10 && n_active[1] > 30 && n_active[2] > 30 && (phi == 0 || n_active[3] > 10));
        }
  }

  /** Tension on all sides: the apex, or the limit. */
  void tension()
  {
    Soil         dry(35, 0, 0), moist(35, 20, 0.5), weak(35, 20, 0.5, set("Tension strength", "0.1"));
    const double stresses[] = {0, 0.5 / std::tan(radians(35)), 0.1};
    unsigned int i          = 0;
    for (Soil *p : {&dry, &moist, &weak})
    {
      p->advance(diagonal(1, 1, 1), 1e-2);
      check("stress", distance(p->stress(), pressure(-stresses[i])), 1e-13);
      check("volumetric plastic strain", p->states[1] - (3e-2 - stresses[i] / K), 1e-15);
      check("no equivalent plastic strain", p->states[0], 1e-15);
      ++i;
    }
  }

  /** Without friction: the greatest shear stress is c (Tresca), whatever the middle stress. */
  void no_friction()
  {
    Soil   p(0, 0, 2);
    double shear = 0;
    for (unsigned int n = 0; n < 200; ++n)
    {
      p.advance(some_tensor(0.37 * n) + diagonal(1, 1, 1), 2e-3);
      SymmetricTensor<2, 3> stress = symmetrize(p.stress());
      const auto            values = eigenvectors(stress, SymmetricTensorEigenvectorMethod::jacobi);
      shear                        = std::max(shear, (values[0].first - values[2].first) / 2);
    }
    check("greatest shear stress", shear - 2, 1e-12);
    check("no plastic volume", p.states[1], 1e-14);
    check_true("it yields", p.states[0] > 0.1);
  }

} // namespace mohr_coulomb
