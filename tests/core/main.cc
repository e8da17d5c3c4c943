#include "../check.h"

void syntax_errors();
void value_errors();
void unknown_entries();
void overrides();
void idle_entries();
void included_files();
void located_errors();
void printing();
void names();
void expressions();
void reduction();
void traffic();
void table();
void archive();
void json();
void text_files();
void registry();
void simd();
void batches();
void eigen_systems();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"json", json},
                    {"parameters: syntax errors", syntax_errors},
                    {"parameters: value errors", value_errors},
                    {"parameters: unknown entries", unknown_entries},
                    {"parameters: overrides", overrides},
                    {"parameters: idle entries", idle_entries},
                    {"parameters: included files", included_files},
                    {"parameters: located errors", located_errors},
                    {"parameters: printing", printing},
                    {"parameters: names", names},
                    {"expressions", expressions},
                    {"reduction", reduction},
                    {"traffic", traffic},
                    {"table", table},
                    {"archive", archive},
                    {"text files", text_files},
                    {"registry", registry},
                    {"simd", simd},
                    {"batches", batches},
                    {"eigen systems", eigen_systems}});
}
