// SPDX-License-Identifier: MIT
// Depth pass: nothing but depth is stored.
void main() {}
