#include <talus/core/registry.h>
#include <talus/kernels/lattice/treatment.h>

namespace Talus
{
  namespace
  {
    /** Missing nodes are left out and nothing else happens. */
    template <int dim>
    class Truncated : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;
    };

    /**
     * Steffen, Kirby & Berzins (2008), Fig. 3(a): per axis the boundary node's
     * function is scaled to one at the boundary, and the next node takes what is
     * missing to a partition of unity. Linear fields are not reproduced.
     */
    template <int dim>
    class Steffen : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;

      void correct_factors(LatticeFactors<dim> &factors) const override
      {
        for (unsigned int d = 0; d < dim; ++d)
        {
          adjust(factors, d, 0., 1.);
          adjust(factors, d, factors.last[d], factors.last[d] - 1);
        }
      }
      bool needs_boundary_scale() const override { return true; }

    private:
      /** In the lanes whose stencil holds the boundary node. */
      static void adjust(LatticeFactors<dim> &factors, const unsigned int d, const double boundary, const double next)
      {
        using Number       = typename LatticeFactors<dim>::Number;
        const auto is_node = [&](const unsigned int k, const double node) {
          return factors.first[d] + static_cast<double>(k) == Number(node);
        };
        Number weight = 1., derivative = 0.;
        auto   is_there = Number(1.) < Number(0.);
        for (unsigned int k = 0; k < factors.n; ++k)
        {
          const auto   is_boundary = is_node(k, boundary);
          const Number scale       = select(is_boundary, Number(factors.boundary_scale), Number(1.));
          factors.weight[d][k] *= scale;
          factors.derivative[d][k] *= scale;
          is_there = is_there | is_boundary;
          weight -= select(is_node(k, next), Number(0.), factors.weight[d][k]);
          derivative -= select(is_node(k, next), Number(0.), factors.derivative[d][k]);
        }
        for (unsigned int k = 0; k < factors.n; ++k)
        {
          const auto is_next       = is_there & is_node(k, next);
          factors.weight[d][k]     = select(is_next, weight, factors.weight[d][k]);
          factors.derivative[d][k] = select(is_next, derivative, factors.derivative[d][k]);
        }
      }
    };

    /**
     * Sums over an axis that its least squares need. The weight of a node is a
     * product, so the moment matrix of a batch of particles is made of these:
     * with mean mu and variance of the offsets under w / m0,
     * @f[ M^{-1} P = ( 1 - \sum_d \mu_d (o_d - \mu_d) / var_d ,\; (o_d - \mu_d) / var_d ) / \prod_d m0_d . @f]
     */
    template <int dim>
    struct AxisMoments
    {
      using Number = typename LatticeFactors<dim>::Number;

      AxisMoments(const LatticeFactors<dim> &factors, const unsigned int d)
      {
        for (unsigned int k = 0; k < factors.n; ++k)
        {
          const Number w = factors.weight[d][k], o = factors.offset[d][k];
          sum += w;
          mean += w * o;
          variance += w * o * o;
        }
        mean /= sum;
        variance = variance / sum - mean * mean;
      }

      Number sum = 0., mean = 0., variance = 0.;
    };

    template <int dim>
    typename LatticeFactors<dim>::Mask is_any_truncated(const LatticeFactors<dim> &factors)
    {
      auto result = factors.is_truncated[0];
      for (unsigned int d = 1; d < dim; ++d)
        result = result | factors.is_truncated[d];
      return result;
    }

    /** Weighted least squares, Eqs. (53)-(63), where a node of the support is missing. */
    template <int dim>
    class WeightedLeastSquares : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;

      void correct_factors(LatticeFactors<dim> &factors) const override
      {
        using Number = typename LatticeFactors<dim>::Number;
        // One truncated axis changes the gradient along all of them.
        const auto is_corrected =
          this->is_everywhere() && factors.n > 2 ? Number(0.) == Number(0.) : is_any_truncated(factors);
        for (unsigned int d = 0; d < dim; ++d)
        {
          const AxisMoments<dim> moments(factors, d);
          for (unsigned int k = 0; k < factors.n; ++k)
          {
            const Number weight      = factors.weight[d][k] / moments.sum;
            const Number derivative  = weight * (factors.offset[d][k] - moments.mean) / moments.variance;
            factors.weight[d][k]     = select(is_corrected, weight, factors.weight[d][k]);
            factors.derivative[d][k] = select(is_corrected, derivative, factors.derivative[d][k]);
            factors.coupling[d][k]   = select(is_corrected, moments.mean * derivative, Number(0.));
          }
        }
        factors.is_coupled = true;
      }
    };

    /** The same for all particles: with TPIC this is MLS-MPM, Fig. 3(b). */
    template <int dim>
    class WeightedLeastSquaresEverywhere : public WeightedLeastSquares<dim>
    {
    public:
      using WeightedLeastSquares<dim>::WeightedLeastSquares;
      bool is_everywhere() const override { return true; }
    };

    /** Weighted least squares on each truncated axis alone: hardly any negative weights in corners. */
    template <int dim>
    class SeparableWeightedLeastSquares : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;

      void correct_factors(LatticeFactors<dim> &factors) const override
      {
        using Number = typename LatticeFactors<dim>::Number;
        for (unsigned int d = 0; d < dim; ++d)
        {
          const AxisMoments<dim> moments(factors, d);
          for (unsigned int k = 0; k < factors.n; ++k)
          {
            const Number weight     = factors.weight[d][k] / moments.sum;
            const Number derivative = weight * (factors.offset[d][k] - moments.mean) / moments.variance;
            factors.weight[d][k] =
              select(factors.is_truncated[d], weight - moments.mean * derivative, factors.weight[d][k]);
            factors.derivative[d][k] = select(factors.is_truncated[d], derivative, factors.derivative[d][k]);
          }
        }
      }
    };

    /**
     * Beyond a slip wall the domain goes on as its mirror image: node -k is node k with the opposite velocity along the
     * normal, in both directions of the transfer. The kernels stay as they are there; at other faces they are corrected
     * by separable least squares.
     */
    template <int dim>
    class Mirror : public SeparableWeightedLeastSquares<dim>
    {
    public:
      using SeparableWeightedLeastSquares<dim>::SeparableWeightedLeastSquares;
      bool is_mirror() const override { return true; }
    };

    /**
     * The grid goes on beyond its faces: kernels stay as they are, and the nodes beyond are folded onto those before,
     * as the conditions there say. See Walls.
     */
    template <int dim>
    class GhostNodes : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;
      bool has_ghosts() const override { return true; }
    };

    /** Moving least squares, Fig. 3(c): the derivative of M(x)^{-1} P is taken as well. */
    template <int dim>
    class MovingLeastSquares : public Treatment<dim>
    {
    public:
      using Treatment<dim>::Treatment;

      void correct_factors(LatticeFactors<dim> &factors) const override
      {
        using Number            = typename LatticeFactors<dim>::Number;
        const auto is_corrected = is_any_truncated(factors);
        for (unsigned int d = 0; d < dim; ++d)
        {
          // Derivatives of the moments along the axis; an offset's is -1.
          const AxisMoments<dim> moments(factors, d);
          Number                 dsum = 0., dfirst = 0., dsecond = 0.;
          for (unsigned int k = 0; k < factors.n; ++k)
          {
            const Number dw = factors.derivative[d][k], o = factors.offset[d][k];
            dsum += dw;
            dfirst += dw * o - factors.weight[d][k];
            dsecond += (dw * o - 2. * factors.weight[d][k]) * o;
          }
          const Number second    = moments.variance + moments.mean * moments.mean;
          const Number dmean     = (dfirst - moments.mean * dsum) / moments.sum;
          const Number dvariance = (dsecond - second * dsum) / moments.sum - 2. * moments.mean * dmean;
          for (unsigned int k = 0; k < factors.n; ++k)
          {
            const Number weight   = factors.weight[d][k] / moments.sum;
            const Number dweight  = (factors.derivative[d][k] - weight * dsum) / moments.sum;
            const Number distance = factors.offset[d][k] - moments.mean;
            const Number q        = moments.mean * distance / moments.variance; // u = w q
            const Number dq       = (dmean * distance - moments.mean * (1. + dmean) - q * dvariance) / moments.variance;
            factors.weight[d][k]  = select(is_corrected, weight, factors.weight[d][k]);
            factors.coupling[d][k] = select(is_corrected, weight * q, Number(0.));
            factors.cross[d][k]    = select(is_corrected, dweight, factors.derivative[d][k]);
            factors.derivative[d][k] =
              select(is_corrected, dweight - dweight * q - weight * dq, factors.derivative[d][k]);
          }
        }
        factors.is_coupled = factors.has_cross = true;
      }
    };

    const RegisterDimensions<Treatment, Truncated> none("none", "missing nodes are left out");
    const RegisterDimensions<Treatment, Steffen>   steffen(
        "Steffen", "modified B-splines at the boundary (partition of unity only)");
    const RegisterDimensions<Treatment, WeightedLeastSquares>           wls("WLS",
                                                                            "weighted least squares where nodes are missing");
    const RegisterDimensions<Treatment, WeightedLeastSquaresEverywhere> everywhere(
      "WLS everywhere", "weighted least squares for all particles: MLS-MPM with TPIC");
    const RegisterDimensions<Treatment, SeparableWeightedLeastSquares> separable(
      "WLS separable", "weighted least squares on each truncated axis alone");
    const RegisterDimensions<Treatment, Mirror> mirror(
      "mirror", "nodes beyond a slip wall mirror those before it; 'WLS separable' at other faces");
    const RegisterDimensions<Treatment, GhostNodes> ghost_nodes(
      "ghost nodes", "complete kernels: nodes beyond the faces move as the conditions there say");
    const RegisterDimensions<Treatment, MovingLeastSquares> mls("MLS", "moving least squares where nodes are missing");
  } // namespace
} // namespace Talus
