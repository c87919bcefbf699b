// SPDX-License-Identifier: Apache-2.0
// The colours of the two objects, as src/scene/view.ts has them; that file cannot be read without a browser.
export const COLOUR_A_HEX = 0xe69f00;
export const COLOUR_B_HEX = 0x2f8fd8;
