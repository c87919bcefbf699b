// SPDX-License-Identifier: Apache-2.0
// Two boxes of 100 mm, the second pushed 10 mm into the first, as an OBJ file.
#pragma once

#include <array>
#include <filesystem>
#include <fstream>

inline std::filesystem::path two_boxes() {
  const std::filesystem::path path = "two_boxes.obj";
  std::ofstream file(path);
  file << "# unit: mm\n";
  constexpr std::array<std::array<int, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (int box = 0; box < 2; ++box) {
    file << "o box" << box << '\n';
    for (int corner = 0; corner < 8; ++corner)
      file << "v " << box * 90 + (corner & 1) * 100 << ' ' << (corner >> 1 & 1) * 100 << ' '
           << (corner >> 2) * 100 << '\n';
    for (const auto& side : kSides) {
      file << 'f';
      for (const int corner : side) file << ' ' << box * 8 + corner + 1;
      file << '\n';
    }
  }
  return path;
}
