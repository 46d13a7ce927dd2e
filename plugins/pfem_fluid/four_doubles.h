#pragma once

#include "element_passes.h"

// Arithmetic on four doubles for the element passes, a part of each file that is compiled once per instruction set.

namespace Breakwater
{
  namespace BREAKWATER_INSTRUCTION_SET
  {
    template <int dim>
    void set_stress_passes(ElementPasses &passes);
    template <int dim>
    void set_filter_pass(ElementPasses &passes);
    template <int dim>
    void set_mesh_passes(ElementPasses &passes);

    namespace
    {
      typedef double V4 __attribute__((vector_size(32)));
      typedef long   I4 __attribute__((vector_size(32)));

      inline V4 load(const Quad &q)
      {
        return *reinterpret_cast<const V4 *>(q.c);
      }
      inline void store(Quad &q, const V4 &v)
      {
        *reinterpret_cast<V4 *>(q.c) = v;
      }
      inline V4 all(const double s)
      {
        return V4{s, s, s, s};
      }
    } // namespace
  }   // namespace BREAKWATER_INSTRUCTION_SET
} // namespace Breakwater
