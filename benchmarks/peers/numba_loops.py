"""The loops of the Numba program; importing this module needs Numba and SciPy (for the tableau)."""

from __future__ import annotations

import numpy as np
from numba import njit as jit
from scipy.integrate import RK45

njit = jit(fastmath={"contract", "reassoc", "arcp", "nsz"})
A, B, E, P = RK45.A.copy(), RK45.B.copy(), RK45.E.copy(), RK45.P.copy()


@njit
def terms(joints, ends, y, gains, rows, b):
    """Phi_q by its two blocks for each joint, and b = -gamma-hat."""
    n = y.size // 2
    alpha, beta = gains
    for k in range(len(joints)):
        x0 = y0 = vx = vy = gx = gy = 0.0
        for side in range(2):
            body, sign = joints[k, side], 2.0 * side - 1.0
            sx, sy = ends[k, side]
            if body < 0:
                x0 += sign * sx
                y0 += sign * sy
                continue
            at = 3 * body
            c, s = np.cos(y[at + 2]), np.sin(y[at + 2])
            ux, uy, omega = c * sx - s * sy, s * sx + c * sy, y[n + at + 2]
            x0 += sign * (y[at] + ux)
            y0 += sign * (y[at + 1] + uy)
            vx += sign * (y[n + at] - uy * omega)
            vy += sign * (y[n + at + 1] + ux * omega)
            gx += sign * ux * omega * omega
            gy += sign * uy * omega * omega
            rows[k, side, 0], rows[k, side, 1] = -sign * uy, sign * ux
        b[2 * k] = -gx + 2 * alpha * vx + beta * beta * x0
        b[2 * k + 1] = -gy + 2 * alpha * vy + beta * beta * y0


@njit
def condensed(joints, mass, rows, S):
    """S, its lower triangle, from joints that share a body."""
    S[:] = 0.0
    for k in range(len(joints)):
        for m in range(k + 1):
            for side in range(2):
                for other in range(2):
                    body = joints[k, side]
                    if body < 0 or body != joints[m, other]:
                        continue
                    signs = (2.0 * side - 1.0) * (2.0 * other - 1.0)
                    for r in range(2):
                        S[2 * k + r, 2 * m + r] += signs / mass[body, 0]
                        for c in range(2):
                            product = rows[k, side, r] * rows[m, other, c]
                            S[2 * k + r, 2 * m + c] += product / mass[body, 1]


@njit
def cholesky_solve(S, b):
    """Factorises S in place and overwrites b with the solution."""
    n = b.size
    for i in range(n):
        for j in range(i + 1):
            total = S[i, j]
            for k in range(j):
                total -= S[i, k] * S[j, k]
            S[i, j] = np.sqrt(total) if i == j else total / S[j, j]
        for k in range(i):
            b[i] -= S[i, k] * b[k]
        b[i] /= S[i, i]
    for i in range(n - 1, -1, -1):
        for k in range(i + 1, n):
            b[i] -= S[k, i] * b[k]
        b[i] /= S[i, i]


@njit
def pull_springs(springs, y, force):
    """Adds the forces of springs between points to Q."""
    for k in range(len(springs)):
        line = np.zeros(2)
        arm = np.zeros((2, 2))
        for side in range(2):
            body, sx, sy = int(springs[k, side]), springs[k, 2 + 2 * side], springs[k, 3 + 2 * side]
            sign = 2.0 * side - 1.0
            if body < 0:
                line[0] += sign * sx
                line[1] += sign * sy
                continue
            c, s = np.cos(y[3 * body + 2]), np.sin(y[3 * body + 2])
            arm[side, 0], arm[side, 1] = c * sx - s * sy, s * sx + c * sy
            line[0] += sign * (y[3 * body] + arm[side, 0])
            line[1] += sign * (y[3 * body + 1] + arm[side, 1])
        length = np.sqrt(line[0] ** 2 + line[1] ** 2)
        pull = -springs[k, 6] * (1.0 - springs[k, 7] / length)
        for side in range(2):
            body, sign = int(springs[k, side]), 2.0 * side - 1.0
            if body >= 0:
                fx, fy = sign * pull * line[0], sign * pull * line[1]
                force[3 * body] += fx
                force[3 * body + 1] += fy
                force[3 * body + 2] += arm[side, 0] * fy - arm[side, 1] * fx


@njit
def rate(model, y, gains, work, dy):
    """Dy = (v, a)."""
    joints, ends, mass, gravity, torsion, springs, torques = model
    rows, b, S, force = work
    n = y.size // 2
    for k in range(len(mass)):
        force[3 * k], force[3 * k + 1], force[3 * k + 2] = 0.0, -mass[k, 0] * gravity, 0.0
    for k in range(len(torques)):
        force[3 * int(torques[k, 0]) + 2] += torques[k, 1]
    for k in range(len(torsion)):
        at = 3 * int(torsion[k, 0]) + 2
        force[at] -= torsion[k, 1] * (y[at] - torsion[k, 3]) + torsion[k, 2] * y[n + at]
    pull_springs(springs, y, force)
    terms(joints, ends, y, gains, rows, b)
    condensed(joints, mass, rows, S)
    for k in range(len(joints)):
        for side in range(2):
            body, sign = joints[k, side], 2.0 * side - 1.0
            if body >= 0:
                for r in range(2):
                    b[2 * k + r] += sign * force[3 * body + r] / mass[body, 0]
                    b[2 * k + r] += rows[k, side, r] * force[3 * body + 2] / mass[body, 1]
    cholesky_solve(S, b)
    for k in range(len(joints)):
        for side in range(2):
            body, sign = joints[k, side], 2.0 * side - 1.0
            if body >= 0:
                for r in range(2):
                    force[3 * body + r] -= sign * b[2 * k + r]
                    force[3 * body + 2] -= rows[k, side, r] * b[2 * k + r]
    for k in range(len(mass)):
        dy[n + 3 * k] = force[3 * k] / mass[k, 0]
        dy[n + 3 * k + 1] = force[3 * k + 1] / mass[k, 0]
        dy[n + 3 * k + 2] = force[3 * k + 2] / mass[k, 1]
    dy[:n] = y[n:]


@njit
def norm(x, scale):
    """Root mean square of x / scale."""
    return np.sqrt(np.mean((x / scale) ** 2))


@njit
def first_step(model, y, gains, work, k, rtol, atol):
    """Hairer's; k[0] is given, k[1] is lost."""
    scale = atol + rtol * np.abs(y)
    d0, d1 = norm(y, scale), norm(k[0], scale)
    h0 = 1e-6 if d0 < 1e-5 or d1 < 1e-5 else 0.01 * d0 / d1
    rate(model, y + h0 * k[0], gains, work, k[1])
    d2 = norm(k[1] - k[0], scale) / h0
    return min(100 * h0, (0.01 / max(d1, d2)) ** 0.2)


@njit
def integrate(model, y, gains, work, grid, rtol, atol, most):
    """States on the grid, and how many rows were reached in `most` tries of a step."""
    k = np.zeros((7, y.size))
    out = np.zeros((grid.size, y.size))
    out[0] = y
    rate(model, y, gains, work, k[0])
    h = first_step(model, y, gains, work, k, rtol, atol)
    t, row, rejected = 0.0, 1, False
    for _ in range(most):
        if row == grid.size:
            break
        for s in range(1, 6):
            trial = y.copy()
            for m in range(s):
                if A[s, m] != 0.0:
                    trial += h * A[s, m] * k[m]
            rate(model, trial, gains, work, k[s])
        new = y.copy()
        wrong = np.zeros(y.size)
        for s in range(6):
            new += h * B[s] * k[s]
            wrong += h * E[s] * k[s]
        rate(model, new, gains, work, k[6])
        wrong += h * E[6] * k[6]
        worst = norm(wrong, atol + rtol * np.maximum(np.abs(y), np.abs(new)))
        if not worst < 1.0:
            h *= max(0.2, 0.9 * worst**-0.2) if worst > 0 else 0.2
            rejected = True
            continue
        while row < grid.size and grid[row] <= t + h:
            theta = (grid[row] - t) / h
            out[row] = y
            for s in range(7):
                p = P[s]
                weight = theta * (p[0] + theta * (p[1] + theta * (p[2] + theta * p[3])))
                out[row] += h * weight * k[s]
            row += 1
        t += h
        h *= min(1.0 if rejected else 10.0, 0.9 * max(worst, 1e-30) ** -0.2)
        y, rejected = new, False
        k[0] = k[6]
    return out, row
