#include "check.h"

void test_fields();
void test_particle_csv();
void test_totals();
void test_directory();
void test_is_due();
void test_vtu_arrays();
void test_vtu();
void test_grid_output();
void test_statistics();
void test_probes();
void test_probe_errors();
void test_progress();

int main(int argc, char **argv)
{
  return Test::run(argc, argv,
                   {{"particle fields", test_fields},
                    {"particle CSV", test_particle_csv},
                    {"totals", test_totals},
                    {"output directory", test_directory},
                    {"output due", test_is_due},
                    {"VTU arrays", test_vtu_arrays},
                    {"VTU and PVD", test_vtu},
                    {"grid output", test_grid_output},
                    {"statistics", test_statistics},
                    {"probes", test_probes},
                    {"probe errors", test_probe_errors},
                    {"progress", test_progress}});
}
