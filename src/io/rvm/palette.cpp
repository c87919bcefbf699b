// SPDX-License-Identifier: Apache-2.0
#include "io/rvm/palette.hpp"

#include <array>

namespace strake::io::rvm {

namespace {

struct Percent {
  std::uint8_t red, green, blue;
};

// clang-format off
constexpr std::array<Percent, 32> kLow = {{
    {0, 0, 0},  // 1 Black
    {80, 0, 0},  // 2 Red
    {93, 60, 0},  // 3 Orange
    {80, 80, 0},  // 4 Yellow
    {0, 80, 0},  // 5 Green
    {0, 93, 93},  // 6 Cyan
    {0, 0, 80},  // 7 Blue
    {87, 0, 87},  // 8 Magenta
    {80, 17, 17},  // 9 Brown
    {100, 100, 100},  // 10 White
    {98, 50, 44},  // 11 Salmon
    {75, 75, 75},  // 12 LightGrey
    {66, 66, 66},  // 13 Grey
    {55, 40, 55},  // 14 Plum
    {96, 96, 96},  // 15 WhiteSmoke
    {56, 14, 42},  // 16 Maroon
    {0, 100, 50},  // 17 SpringGreen
    {96, 87, 70},  // 18 Wheat
    {93, 79, 20},  // 19 Gold
    {28, 46, 100},  // 20 RoyalBlue
    {93, 91, 67},  // 21 LightGold
    {93, 7, 54},  // 22 DeepPink
    {14, 56, 14},  // 23 ForestGreen
    {100, 65, 0},  // 24 BrightOrange
    {93, 93, 88},  // 25 Ivory
    {93, 46, 13},  // 26 Chocolate
    {28, 51, 71},  // 27 SteelBlue
    {100, 100, 100},  // 28 White
    {18, 18, 31},  // 29 Midnight
    {0, 0, 50},  // 30 NavyBlue
    {80, 57, 62},  // 31 Pink
    {80, 36, 27},  // 32 CoralRed
}};

constexpr std::array<Percent, 50> kHigh = {{
    {0, 0, 0},  // 206 Black
    {100, 100, 100},  // 207 White
    {96, 96, 96},  // 208 WhiteSmoke
    {93, 93, 88},  // 209 Ivory
    {66, 66, 66},  // 210 Grey
    {75, 75, 75},  // 211 LightGrey
    {32, 55, 55},  // 212 DarkGrey
    {18, 31, 31},  // 213 DarkSlate
    {80, 0, 0},  // 214 Red
    {100, 0, 0},  // 215 BrightRed
    {80, 36, 27},  // 216 CoralRed
    {100, 39, 28},  // 217 Tomato
    {55, 40, 55},  // 218 Plum
    {93, 7, 54},  // 219 DeepPink
    {80, 57, 62},  // 220 Pink
    {98, 50, 44},  // 221 Salmon
    {93, 60, 0},  // 222 Orange
    {100, 65, 0},  // 223 BrightOrange
    {100, 50, 0},  // 224 OrangeRed
    {56, 14, 42},  // 225 Maroon
    {80, 80, 0},  // 226 Yellow
    {93, 79, 20},  // 227 Gold
    {93, 93, 82},  // 228 LightYellow
    {93, 91, 67},  // 229 LightGold
    {60, 80, 20},  // 230 YellowGreen
    {0, 100, 50},  // 231 SpringGreen
    {0, 80, 0},  // 232 Green
    {14, 56, 14},  // 233 ForestGreen
    {18, 31, 18},  // 234 DarkGreen
    {0, 93, 93},  // 235 Cyan
    {0, 75, 80},  // 236 Turquoise
    {46, 93, 78},  // 237 Aquamarine
    {0, 0, 80},  // 238 Blue
    {28, 46, 100},  // 239 RoyalBlue
    {0, 0, 50},  // 240 NavyBlue
    {69, 88, 90},  // 241 PowderBlue
    {18, 18, 31},  // 242 Midnight
    {28, 51, 71},  // 243 SteelBlue
    {20, 0, 40},  // 244 Indigo
    {40, 0, 60},  // 245 Mauve
    {93, 51, 93},  // 246 Violet
    {87, 0, 87},  // 247 Magenta
    {96, 96, 86},  // 248 Beige
    {96, 87, 70},  // 249 Wheat
    {86, 58, 44},  // 250 Tan
    {96, 65, 37},  // 251 SandyBrown
    {80, 17, 17},  // 252 Brown
    {62, 62, 37},  // 253 Khaki
    {93, 46, 13},  // 254 Chocolate
    {55, 27, 8},  // 255 DarkBrown
}};
// clang-format on

constexpr std::uint8_t to_byte(std::uint8_t percent) {
  return static_cast<std::uint8_t>((percent * 255 + 50) / 100);
}

constexpr model::Color to_color(Percent p) {
  return {to_byte(p.red), to_byte(p.green), to_byte(p.blue), 255};
}

}  // namespace

std::optional<model::Color> default_color(std::uint32_t index) {
  if (index == 0) return to_color({47, 47, 47});
  if (index <= 64) return to_color(kLow[(index - 1) % 32]);
  if (index >= 206 && index <= 255) return to_color(kHigh[index - 206]);
  return std::nullopt;
}

}  // namespace strake::io::rvm
