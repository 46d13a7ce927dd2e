#include <breakwater/base/abi.h>

#include <cstdio>

int main()
{
  std::puts(BREAKWATER_ABI_TAG);
  return 0;
}
