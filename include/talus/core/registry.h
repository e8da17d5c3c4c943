#pragma once

#include <talus/core/exceptions.h>

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>

namespace Talus
{
  class Parameters;

  /**
   * All objects of one kind (kernels, transfers, materials, ...) by name. A
   * factory takes the section of the parameter file that the new object reads,
   * and the parameters, of which it asks what its own parts are.
   */
  template <class Interface>
  class Registry
  {
  public:
    using Factory = std::function<std::unique_ptr<Interface>(Parameters &parameters, const std::string &section)>;

    struct Entry
    {
      std::string help;
      Factory     make;
    };

    /** The one registry of this kind. */
    static Registry &get()
    {
      static Registry registry;
      return registry;
    }

    void add(const std::string &name, const std::string &help, Factory make)
    {
      const bool is_new = entries.emplace(name, Entry{help, std::move(make)}).second;
      AssertThrow(is_new, dealii::ExcMessage("'" + name + "' is registered twice."));
    }

    std::unique_ptr<Interface> make(const std::string &name, Parameters &parameters, const std::string &section) const
    {
      const auto entry = entries.find(name);
      AssertThrow(entry != entries.end(), InputError("Nothing is registered as '" + name + "'."));
      return entry->second.make(parameters, section);
    }

    const std::map<std::string, Entry> &all() const { return entries; }

    /** The names in the form that Patterns::Selection reads: "a|b|c". */
    std::string selection() const
    {
      std::string names;
      for (const auto &entry : entries)
        names += (names.empty() ? "" : "|") + entry.first;
      return names;
    }

  private:
    std::map<std::string, Entry> entries;
  };

  /**
   * Registers `Object` for a kind that does not depend on the dimension. Its constructor takes (parameters, section),
   * or the section alone where it has nothing to choose.
   */
  template <class Interface, class Object>
  struct Register
  {
    Register(const std::string &name, const std::string &help)
    {
      Registry<Interface>::get().add(
        name, help, [](Parameters &parameters, const std::string &section) -> std::unique_ptr<Interface> {
          if constexpr (std::is_constructible<Object, Parameters &, const std::string &>::value)
            return std::make_unique<Object>(parameters, section);
          else
            return std::make_unique<Object>(section);
        });
    }
  };

  /** Registers `Object<2>` and `Object<3>`. */
  template <template <int> class Interface, template <int> class Object>
  struct RegisterDimensions
  {
    RegisterDimensions(const std::string &name, const std::string &help)
    {
      Register<Interface<2>, Object<2>>(name, help);
      Register<Interface<3>, Object<3>>(name, help);
    }
  };
} // namespace Talus
