#include "../check.h"

#include <talus/core/json.h>

#include <boost/property_tree/json_parser.hpp>

#include <limits>

/** Another library reads what was written. */
void json()
{
  using namespace Test;
  const std::string hard = "a \"quoted\" word, a \\ and\na tab\t";
  Talus::JsonObject inner, all;
  inner.add("third", 1. / 3);
  inner.add("endless", std::numeric_limits<double>::infinity());
  all.add("text", hard);
  all.add("word", "word");
  all.add("list", std::vector<std::string>{"one", hard});
  all.add("inner", inner);
  std::istringstream          in(all.text());
  boost::property_tree::ptree tree;
  boost::property_tree::read_json(in, tree);
  check_true("text", tree.get<std::string>("text") == hard);
  check_true("word", tree.get<std::string>("word") == "word");
  check_true("list", tree.get_child("list").size() == 2 && tree.get_child("list").back().second.data() == hard);
  check("number", tree.get<double>("inner.third") - 1. / 3, 1e-300);
  check_true("infinity", tree.get<std::string>("inner.endless") == "null");
}
