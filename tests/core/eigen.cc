#include <talus/core/eigen.h>

#include "../setup.h"

using namespace Test;
using namespace dealii;

namespace
{
  /** Numbers without a pattern, and tensors that are special: diagonal, double eigenvalues, tiny or vast entries. */
  SymmetricTensor<2, 3> some(const unsigned int k)
  {
    SymmetricTensor<2, 3> A;
    for (unsigned int c = 0; c < 6; ++c)
      A.access_raw_entry(c) = std::sin(1.7 * k + 2.9 * c);
    if (k % 5 == 1) // nothing off the diagonal
      A[0][1] = A[0][2] = A[1][2] = 0;
    if (k % 5 == 2) // plane strain
      A[0][2] = A[1][2] = 0;
    if (k % 5 == 3) // a double eigenvalue
    {
      A = unit_symmetric_tensor<3>();
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          A[i][j] += std::sin(k + 1. * i) * std::sin(k + 1. * j);
    }
    if (k % 5 == 4)
      A[0][1] *= 1e-9;
    return (k % 3 == 1 ? 1e-140 : k % 3 == 2 ? 1e80 : 1.) * A;
  }

  template <typename Number>
  double error_of(const SymmetricTensor<2, 3, Number> &A, const int l)
  {
    const EigenSystem<Number> system(A);
    const auto                back  = system.assemble(system.value);
    double                    error = 0, size = 0;
    for (unsigned int c = 0; c < 6; ++c)
      size = std::max(size, std::abs(lane(A.access_raw_entry(c), l)));
    for (unsigned int c = 0; c < 6; ++c)
      raise(error, (lane(back.access_raw_entry(c), l) - lane(A.access_raw_entry(c), l)) / std::max(size, 1e-300));
    const auto V = lane(system.vector, l);
    return error + (V * transpose(V) - Tensor<2, 3>(unit_symmetric_tensor<3>())).norm();
  }
} // namespace

/** V diag(values) V^T = A and V V^T = I, one tensor at a time and one in each lane. */
void eigen_systems()
{
  using Number = Simd<native_width>;
  double error = 0, error_of_lanes = 0;
  for (unsigned int k = 0; k < 60; ++k)
  {
    raise(error, error_of(some(k), 0));
    SymmetricTensor<2, 3, Number> A;
    for (int l = 0; l < native_width; ++l)
      for (unsigned int c = 0; c < 6; ++c)
        A.access_raw_entry(c).set(l, some(k + l).access_raw_entry(c));
    for (int l = 0; l < native_width; ++l)
      raise(error_of_lanes, error_of(A, l));
  }
  check("one", error, 1e-14);
  check("lanes", error_of_lanes, 1e-14);
  check("zero", error_of(SymmetricTensor<2, 3>(), 0), 1e-15);

  // In the plane the third eigenvector is across it, with the eigenvalue 0.
  double error_in_plane = 0;
  for (unsigned int k = 0; k < 60; ++k)
  {
    SymmetricTensor<2, 2> A;
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        A[i][j] = some(k)[i][j];
    const auto system = eigen_system(A);
    for (unsigned int i = 0; i < 2; ++i)
      for (unsigned int j = 0; j <= i; ++j)
      {
        double sum = 0;
        for (unsigned int a = 0; a < 2; ++a)
          sum += system.value[a] * system.vector[i][a] * system.vector[j][a];
        raise(error_in_plane, (sum - A[i][j]) / (A.norm() + 1e-300));
      }
    raise(error_in_plane, system.value[2] / (A.norm() + 1e-300));
    raise(error_in_plane, std::abs(system.vector[2][2]) - 1);
  }
  check("in the plane", error_in_plane, 1e-14);
}
