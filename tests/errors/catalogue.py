"""All wrong inputs, by group."""
import cases
import elements
import meshes
import sections
import surroundings

CASES = {**cases.CASES, **meshes.CASES, **sections.CASES, **surroundings.CASES, **elements.CASES}
BASE = cases.BASE
