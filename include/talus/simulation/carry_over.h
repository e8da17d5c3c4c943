#pragma once

#include <talus/postprocess/checkpoint_file.h>
#include <talus/simulation/stages.h>
#include <talus/steppers/model.h>

#include <map>
#include <optional>
#include <unordered_map>

namespace Talus
{
  /**
   * Takes particles from the end of one stage into the next. The model has been created as the new stage's file says;
   * in it the particles of bodies that were there before are replaced by those of the checkpoint, and keep what laws
   * and transfers of before have no name for. Those of bodies that are new stay as they were created, and those of
   * bodies that are gone are left out. Test: tests/stages.
   */
  template <int dim>
  class CarryOver
  {
  public:
    CarryOver(const CheckpointFile &file, Model<dim> &model);

    /** `check` looks at the particles as they were read. Throws InputError where a body has other particles than
     * before. Collective. */
    void run(const std::function<void()> &check = [] {});

    /** The number that a particle of before has now, or nothing where its body is gone. */
    std::optional<std::uint64_t> new_id(const std::uint64_t id) const;

  private:
    /** A particle's columns by its id, on the rank that id % n_ranks names. */
    using Table = std::unordered_map<std::uint64_t, std::vector<double>>;

    bool is_new(const unsigned int body) const;

    /** Copies the particles of new bodies, and sends what the file has no columns for to where it is looked up. */
    void keep_created();
    void renumber();
    void fill_missing();
    void append_new();

    /** Laws that particles did not have before: what they keep follows from the stress. Throws EntryError. */
    void start_laws();

    Table exchange(std::map<unsigned int, std::vector<double>> &messages, const unsigned int n_numbers) const;

    const CheckpointFile &file;
    Model<dim>           &model;
    Particles<dim>       &particles;

    std::vector<std::uint64_t> first_ids;  // of the bodies of before
    std::vector<int>           now_called; // their numbers now; -1: gone
    std::vector<unsigned int>  missing;    // columns that the file has not
    Table                      created;    // their values
    std::vector<std::uint64_t> new_ids;    // of the particles of new bodies
    std::vector<double>        new_values; // all their columns, particle by particle
  };
} // namespace Talus
