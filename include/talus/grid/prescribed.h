#pragma once

#include <deal.II/base/tensor.h>

#include <array>
#include <vector>

namespace Talus
{
  /**
   * What conditions ask of this rank's nodes at the end of a step: components of velocities that they hold, and faces
   * with Coulomb friction. Whoever solves for the velocities (see Walls) enters what that took from the body.
   */
  template <int dim>
  class Prescribed
  {
  public:
    static constexpr unsigned int nobody = static_cast<unsigned int>(-1);

    /** A face that a node may press against along one axis. */
    struct Contact
    {
      double                 outward     = 0; // the face's normal along the axis, 1 or -1; 0: there is none
      double                 coefficient = 0; // mu [1]
      dealii::Tensor<1, dim> velocity;        // of the wall [length/time]
      unsigned int           condition = nobody;

      // Normal impulse that friction has not used yet, how long it stays, and the mean of what there is in a step;
      // after the step what they have become. Walls::press() says what for.
      double account_time = 0;      // 0: there is no account [time]
      double account = 0, mean = 0; // [momentum]

      dealii::Tensor<1, dim> impulse; // taken from the body [momentum]
      bool                   acts = false;
    };

    struct Node
    {
      unsigned int                  node;
      std::array<unsigned int, dim> holder;         // the condition that holds a component, or nobody
      std::array<bool, dim>         is_symmetric{}; // held in a plane of symmetry, with its acceleration
      dealii::Tensor<1, dim>        velocity;       // of what is held [length/time]
      std::array<Contact, dim>      contact;        // by axis

      dealii::Tensor<1, dim> impulse;       // taken from the body by what is held [momentum]
      dealii::Tensor<1, dim> force_impulse; // the share of stress, body force and tractions in it [momentum]
    };

    /** Forgets the last step. */
    void clear(const unsigned int n_nodes)
    {
      for (const Node &node : nodes)
        place[node.node] = nobody;
      nodes.clear();
      place.resize(n_nodes, nobody);
    }

    /** Sets a component of a node's velocity. The last condition of the list has the last word, and pays alone. */
    void hold(const unsigned int i, const unsigned int component, const double velocity,
              const bool is_symmetric = false)
    {
      Node &node                   = entry(i);
      node.holder[component]       = condition;
      node.velocity[component]     = velocity;
      node.is_symmetric[component] = is_symmetric;
    }

    /** Lets a node press against a face. Of two conditions on one face the last has it. */
    Contact &press(const unsigned int i, const unsigned int axis, const double outward, const double coefficient,
                   const dealii::Tensor<1, dim> &velocity)
    {
      Contact &contact    = entry(i).contact[axis];
      contact             = {};
      contact.outward     = outward;
      contact.coefficient = coefficient;
      contact.velocity    = velocity;
      contact.condition   = condition;
      return contact;
    }

    /** What is asked of a node of which something is. */
    Node &of(const unsigned int i) { return nodes[place[i]]; }

    unsigned int      condition = 0; // number of the one that speaks
    std::vector<Node> nodes;         // of which something is asked

  private:
    Node &entry(const unsigned int i)
    {
      if (place[i] == nobody)
      {
        place[i] = nodes.size();
        nodes.push_back({});
        nodes.back().node = i;
        nodes.back().holder.fill(nobody);
      }
      return nodes[place[i]];
    }

    std::vector<unsigned int> place; // of a node in the list
  };
} // namespace Talus
