// SPDX-License-Identifier: Apache-2.0
#include <cstdio>
#include <strake/generate/ship.hpp>

int main() {
  const auto ship = strake::generate::generate_ship({.objects = 200}, {});
  if (!ship) return std::puts(ship.error().text().c_str()), 1;
  std::printf("%zu objects, %zu pairs\n", ship->model.objects.size(), ship->truth.pairs.size());
  return ship->model.objects.size() == 200 && !ship->truth.pairs.empty() ? 0 : 1;
}
