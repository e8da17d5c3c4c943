#pragma once

#include <deal.II/base/tensor.h>

#include <vector>

namespace Talus
{
  /** A named part of a grid's boundary as conditions see it. */
  template <int dim>
  struct BoundaryPart
  {
    std::vector<unsigned int> nodes; // that this rank owns

    /**
     * For each of them the outward unit normals of the part's faces that meet there: one on a plane, several where it
     * turns.
     */
    std::vector<std::vector<dealii::Tensor<1, dim>>> normals;

    /** An orthonormal basis of what they span. */
    std::vector<std::vector<dealii::Tensor<1, dim>>> basis;

    /** Faces of a box, as bits: what they bear as mirrors is borne by this part; see NodalFields::mirrored_force. */
    unsigned int mirrored_faces = 0;

    void add(const unsigned int node, const std::vector<dealii::Tensor<1, dim>> &its_normals)
    {
      nodes.push_back(node);
      normals.push_back(its_normals);
      basis.emplace_back();
      for (dealii::Tensor<1, dim> n : its_normals)
      {
        for (const auto &b : basis.back())
          n -= (n * b) * b;
        if (n.norm() > 1e-6)
          basis.back().push_back(n / n.norm());
      }
    }
  };
} // namespace Talus
