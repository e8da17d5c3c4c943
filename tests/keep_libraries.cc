// Linked into sanitized builds: libraries stay loaded to the end, so that a leak can be told from where it comes. MPI
// closes its own before it has given everything back.
extern "C" int dlclose(void *) { return 0; }

#if defined(__clang__) && defined(__x86_64__)
// Where a value of a class template stands in a signature, Clang writes std:: out in a name and GCC, which has compiled
// deal.II, does not. What bears one name here goes on to the other.
#define LEAD(from, to) asm(".text\n.globl " from "\n.type " from ", @function\n" from ": jmp " to "@PLT\n");

LEAD(
  "_ZNK6dealii16TrilinosWrappers12SparseMatrix5vmultINS_13LinearAlgebra11distributed6VectorIdNS_11MemorySpace4HostEEEEE"
  "NSt9enable_ifIXsr3std7is_sameINT_10value_typeEdEE5valueEvE4typeERSA_RKSA_",
  "_ZNK6dealii16TrilinosWrappers12SparseMatrix5vmultINS_13LinearAlgebra11distributed6VectorIdNS_11MemorySpace4HostEEEEE"
  "NSt9enable_ifIXsrSt7is_sameINT_10value_typeEdE5valueEvE4typeERSB_RKSB_")
LEAD(
  "_ZN6dealii12eigenvectorsILi3EdEESt5arrayISt4pairIT0_NS_6TensorILi1EXT_ES3_EEEXsr3std17integral_constantIiXT_EEE5valueEE"
  "RKNS_15SymmetricTensorILi2EXT_ES3_EENS_32SymmetricTensorEigenvectorMethodE",
  "_ZN6dealii12eigenvectorsILi3EdEESt5arrayISt4pairIT0_NS_6TensorILi1EXT_ES3_EEEXsrSt17integral_constantIiXT_EE5valueEE"
  "RKNS_15SymmetricTensorILi2EXT_ES3_EENS_32SymmetricTensorEigenvectorMethodE")
#endif
