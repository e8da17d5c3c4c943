#include <talus/verification/manufactured_elastic.h>

#include <deal.II/base/numbers.h>

#include <cmath>
#include <iomanip>
#include <sstream>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    constexpr double wave_numbers[3][3] = {{2.0, 1.5, 1.0}, {1.2, 2.2, 1.4}, {1.6, 1.1, 1.9}};
    constexpr double phases[3][3]       = {{0.3, 0.5, 0.9}, {0.7, 0.2, 0.4}, {0.1, 0.8, 0.6}};
  } // namespace

  template <int dim>
  ManufacturedElastic<dim>::ManufacturedElastic(const double bulk_modulus, const double shear_modulus,
                                                const double amplitude) :
    Function<dim>(dim),
    lambda(bulk_modulus - 2. / 3. * shear_modulus), G(shear_modulus), amplitude(amplitude)
  {
  }

  template <int dim>
  double ManufacturedElastic<dim>::derivative(const unsigned int i, const Point<dim> &x,
                                              const std::array<unsigned int, dim> &orders) const
  {
    // d^n/dx^n sin(k x + phi) = k^n sin(k x + phi + n pi/2)
    double product = amplitude;
    for (unsigned int j = 0; j < dim; ++j)
    {
      const double k = wave_numbers[i][j];
      product *= std::pow(k, orders[j]) * std::sin(k * x[j] + phases[i][j] + orders[j] * numbers::PI_2);
    }
    return product;
  }

  template <int dim>
  double ManufacturedElastic<dim>::value(const Point<dim> &x, const unsigned int component) const
  {
    return derivative(component, x, {});
  }

  template <int dim>
  Tensor<1, dim> ManufacturedElastic<dim>::gradient(const Point<dim> &x, const unsigned int component) const
  {
    Tensor<1, dim> gradient;
    for (unsigned int j = 0; j < dim; ++j)
    {
      std::array<unsigned int, dim> orders = {};
      ++orders[j];
      gradient[j] = derivative(component, x, orders);
    }
    return gradient;
  }

  template <int dim>
  SymmetricTensor<2, 3> ManufacturedElastic<dim>::stress(const Point<dim> &x) const
  {
    Tensor<2, 3> grad_u;
    for (unsigned int i = 0; i < dim; ++i)
    {
      const Tensor<1, dim> row = gradient(x, i);
      for (unsigned int j = 0; j < dim; ++j)
        grad_u[i][j] = row[j];
    }
    return lambda * trace(grad_u) * unit_symmetric_tensor<3>() + 2. * G * symmetrize(grad_u);
  }

  template <int dim>
  Tensor<1, dim> ManufacturedElastic<dim>::body_force(const Point<dim> &x) const
  {
    Tensor<1, dim> force;
    for (unsigned int i = 0; i < dim; ++i)
      for (unsigned int j = 0; j < dim; ++j)
      {
        std::array<unsigned int, dim> mixed = {}, twice = {};
        ++mixed[i];
        ++mixed[j];
        twice[j] = 2;
        force[i] -= (lambda + G) * derivative(j, x, mixed) + G * derivative(i, x, twice);
      }
    return force;
  }

  template <int dim>
  std::string ManufacturedElastic<dim>::formulas() const
  {
    std::ostringstream text;
    text << std::setprecision(17);
    for (unsigned int i = 0; i < dim; ++i)
    {
      text << (i == 0 ? "" : "; ") << amplitude;
      for (unsigned int j = 0; j < dim; ++j)
        text << "*sin(" << wave_numbers[i][j] << "*"
             << "xyz"[j] << "+" << phases[i][j] << ")";
    }
    return text.str();
  }

  template class ManufacturedElastic<2>;
  template class ManufacturedElastic<3>;
} // namespace Talus
