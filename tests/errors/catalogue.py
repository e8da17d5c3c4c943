"""All wrong inputs, by group."""
import cases
import meshes
import sections
import surroundings

CASES = {**cases.CASES, **meshes.CASES, **sections.CASES, **surroundings.CASES}
BASE = cases.BASE
