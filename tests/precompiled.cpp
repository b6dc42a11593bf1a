// SPDX-License-Identifier: GPL-3.0-or-later
// Exists only to compile the header.
