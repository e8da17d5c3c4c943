#include <talus/core/archive.h>

#include "../setup.h"

using namespace Test;

namespace
{
  /** Something that remembers a number of each kind. */
  struct Part
  {
    double               number = 0;
    unsigned int         count  = 0;
    std::uint64_t        large  = 0;
    bool                 flag   = false;
    std::vector<double>  list, own;
    dealii::Tensor<1, 3> vector;

    void serialize(Archive &archive)
    {
      const Archive::Scope scope(archive, "part");
      archive("number", number);
      archive("count", count);
      archive("large", large);
      archive("flag", flag);
      archive("list", list);
      archive.of_rank("own", own);
      const Archive::Scope inner(archive, "inner");
      archive("vector", vector);
    }
  };
} // namespace

void archive()
{
  Part part;
  part.number    = std::numeric_limits<double>::infinity();
  part.count     = 4000000000u;
  part.large     = (std::uint64_t{1} << 53) - 1;
  part.flag      = true;
  part.list      = {0.1, -0., 1e-310};
  part.own       = {7.};
  part.vector[2] = 1. / 3;
  Archive written;
  part.serialize(written);
  check_true("writes", !written.is_reading() && written.is_exact());
  check_true("names", written.all_shared().count("part.inner.vector z") == 1 && written.all_of_rank().size() == 1);
  bool is_refused = false;
  try
  {
    part.serialize(written);
  }
  catch (const dealii::ExceptionBase &)
  {
    is_refused = true;
  }
  check_true("twice", is_refused);

  Archive read(written.all_shared(), written.all_of_rank(), /* is_exact = */ true);
  Part    other;
  other.serialize(read);
  check_true("numbers", other.number == part.number && other.count == part.count && other.large == part.large &&
                          other.flag && other.vector == part.vector && other.own == part.own);
  check_true("list", other.list == part.list && std::signbit(other.list[1]));

  auto less = written.all_shared();
  less.erase("part.flag");
  Archive missing(less, {}, true);
  check_error<InputError>("missing", {"has no 'part.flag'", "another version"}, [&] { other.serialize(missing); });
  less["part.flag"] = {};
  Archive wrong(less, {}, true);
  check_error<InputError>("wrong", {"0 numbers 'part.flag' instead of one"}, [&] { other.serialize(wrong); });
}
