"""All wrong inputs, by group."""
import cases
import sections
import surroundings

CASES = {**cases.CASES, **sections.CASES, **surroundings.CASES}
BASE = cases.BASE
