// SPDX-License-Identifier: MIT
// Replaces the program's operator new by one that counts.
#pragma once

/// Calls of operator new so far.
long allocationCount();
