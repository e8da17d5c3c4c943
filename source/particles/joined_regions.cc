#include <talus/core/exceptions.h>
#include <talus/particles/lattice_shape.h>

#include <algorithm>

namespace Talus
{
  using namespace dealii;

  namespace
  {
    /** A region made of others, each in a subsection of its own. */
    template <int dim>
    class Joined : public FilledRegion<dim>
    {
    public:
      Joined(Parameters &parameters, const std::string &section) : FilledRegion<dim>(section)
      {
        names = parameters.names(section, "Regions that it is made of; each has a subsection of this name.");
        for (const auto &name : names)
          parts.push_back(
            parameters.make<FilledRegion<dim>>(section + "/" + name, "Shape", "box", "What kind of region it is."));
      }

      std::string position_entry() const override { return "Names"; }

    protected:
      void read() override
      {
        if (parts.size() < 2)
          throw EntryError(this->get_section_name(), "Names", "give the names of two regions or more.");
        for (const auto &part : parts)
          part->prepare();
      }

      /** The box around all, or that which all have in common. */
      BoundingBox<dim> box(const bool is_common) const
      {
        auto corners = parts[0]->bounding_box().get_boundary_points();
        for (const auto &part : parts)
        {
          const auto more = part->bounding_box().get_boundary_points();
          for (unsigned int d = 0; d < dim; ++d)
          {
            const auto wider = [&](const double a, const double b) {
              return is_common ? std::max(a, b) : std::min(a, b);
            };
            corners.first[d]  = wider(corners.first[d], more.first[d]);
            corners.second[d] = -wider(-corners.second[d], -more.second[d]);
          }
        }
        for (unsigned int d = 0; d < dim; ++d)
          if (!(corners.second[d] > corners.first[d]))
            throw EntryError(this->get_section_name(), "Names", "the body is empty: these have no point in common.");
        return BoundingBox<dim>(corners);
      }

      std::vector<std::string>                        names;
      std::vector<std::unique_ptr<FilledRegion<dim>>> parts;
    };

    /** What lies in any of them. */
    template <int dim>
    class Union : public Joined<dim>
    {
    public:
      using Joined<dim>::Joined;

      BoundingBox<dim> bounding_box() const override { return this->box(/* is_common = */ false); }
      bool             contains(const Point<dim> &x) const override
      {
        return std::any_of(this->parts.begin(), this->parts.end(), [&](const auto &part) { return part->has(x); });
      }
    };

    /** What lies in all of them. */
    template <int dim>
    class Intersection : public Joined<dim>
    {
    public:
      using Joined<dim>::Joined;

      BoundingBox<dim> bounding_box() const override { return this->box(/* is_common = */ true); }
      bool             contains(const Point<dim> &x) const override
      {
        return std::all_of(this->parts.begin(), this->parts.end(), [&](const auto &part) { return part->has(x); });
      }
    };

    /** What lies in the first, and in no other. */
    template <int dim>
    class Difference : public Joined<dim>
    {
    public:
      using Joined<dim>::Joined;

      BoundingBox<dim> bounding_box() const override { return this->parts[0]->bounding_box(); }
      bool             contains(const Point<dim> &x) const override
      {
        return this->parts[0]->has(x) &&
               std::none_of(this->parts.begin() + 1, this->parts.end(), [&](const auto &part) { return part->has(x); });
      }
    };

    const RegisterRegion<Union>        together("union", "what lies in any of some regions");
    const RegisterRegion<Intersection> common("intersection", "what lies in all of some regions");
    const RegisterRegion<Difference>   without("difference", "what lies in the first of some regions and in no other");
  } // namespace
} // namespace Talus
