#pragma once

#include <talus/core/exceptions.h>

#include <deal.II/base/tensor.h>

#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace Talus
{
  /**
   * What a run has to remember from one step to the next, by name: numbers, as doubles. Each part of a run lists its
   * own in a serialize(), which serves both ways, so that what is written is also read:
   *
   *     void serialize(Archive &archive)
   *     {
   *       const Archive::Scope scope(archive, "upkeep");
   *       archive("staleness", staleness);
   *     }
   *
   * What particles carry is no part of it: their columns are known. Test: tests/core/others.cc.
   */
  class Archive
  {
  public:
    using Numbers = std::map<std::string, std::vector<double>>;

    /** To be filled by the parts. */
    Archive() = default;

    /** To be read by the parts; `is_exact`: by the ranks that have written it, each with the particles it had. */
    Archive(Numbers shared, Numbers own, const bool is_exact) :
      shared(std::move(shared)), own(std::move(own)), reads(true), exact(is_exact)
    {
    }

    /** From here on what has no name in it stays as it is, and is no error: for a run that has changed since. */
    void may_lack_names() { lacks = true; }

    bool is_reading() const { return reads; }
    bool is_exact() const { return exact; }

    // Numbers that all ranks have alike.

    void operator()(const std::string &name, std::vector<double> &numbers) { exchange(shared, name, numbers); }

    void operator()(const std::string &name, double &number)
    {
      std::vector<double> numbers(1, number);
      exchange(shared, name, numbers);
      number = the_one(name, numbers);
    }

    /** Of at most 53 bits. */
    template <class Integer, typename = std::enable_if_t<std::is_integral_v<Integer>>>
    void operator()(const std::string &name, Integer &integer)
    {
      double number = static_cast<double>(integer);
      (*this)(name, number);
      integer = static_cast<Integer>(number);
    }

    template <int dim>
    void operator()(const std::string &name, dealii::Tensor<1, dim> &vector)
    {
      for (unsigned int d = 0; d < dim; ++d)
        (*this)(name + " " + "xyz"[d], vector[d]);
    }

    /** Numbers of this rank. Where reading is not exact they are those of all ranks, one rank after the other. */
    void of_rank(const std::string &name, std::vector<double> &numbers) { exchange(own, name, numbers); }

    /** Puts a word before all names, as long as it is there. */
    class Scope
    {
    public:
      Scope(Archive &archive, const std::string &name) : archive(archive), before(archive.prefix)
      {
        archive.prefix += name + '.';
      }
      ~Scope() { archive.prefix = before; }
      Scope(const Scope &) = delete;

    private:
      Archive          &archive;
      const std::string before;
    };

    const Numbers &all_shared() const { return shared; }
    const Numbers &all_of_rank() const { return own; }

  private:
    void   exchange(Numbers &all, const std::string &name, std::vector<double> &numbers);
    double the_one(const std::string &name, const std::vector<double> &numbers) const;

    Numbers     shared, own;
    bool        reads = false, exact = true, lacks = false;
    std::string prefix;
  };
} // namespace Talus
