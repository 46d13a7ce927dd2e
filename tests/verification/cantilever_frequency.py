"""First bending frequency of the dam break's elastic wall against Timoshenko's theory."""

from cmath import exp, sqrt
from math import pi

from _scene import Verification, run


def timoshenko_frequency(length, height, youngs_modulus, poissons_ratio, density, shear_factor=5 / 6):
    """First bending frequency [Hz] of a cantilever of rectangular section, from its characteristic equation:
    kappa G A (w'' - psi') + rho A omega^2 w = 0,  E I psi'' + kappa G A (w' - psi) + rho I omega^2 psi = 0,
    held at 0, free of moment and shear force at the length. Per unit of depth."""
    inertia = height**3 / 12
    shear = shear_factor * youngs_modulus / (2 * (1 + poissons_ratio)) * height
    bending = youngs_modulus * inertia

    def determinant(matrix):
        if len(matrix) == 1:
            return matrix[0][0]
        return sum((-1)**j * matrix[0][j] * determinant([row[:j] + row[j + 1:] for row in matrix[1:]])
                   for j in range(len(matrix)))

    def characteristic(frequency):
        translation = density * height * (2 * pi * frequency)**2
        rotation = density * inertia * (2 * pi * frequency)**2
        a, b, c = shear * bending, shear * rotation + translation * bending, translation * (rotation - shear)
        root = sqrt(b * b - 4 * a * c)
        numbers = [sign * sqrt(square) for square in ((-b + root) / (2 * a), (-b - root) / (2 * a)) for sign in (1, -1)]
        columns = []
        for k in numbers:  # w = exp(k x), psi = p exp(k x)
            p = (shear * k * k + translation) / (shear * k)
            columns.append((1, p, k * p * exp(k * length), (k - p) * exp(k * length)))
        value = determinant([[column[row] for column in columns] for row in range(4)])
        return value.real if abs(value.real) > abs(value.imag) else value.imag

    slender = 1.8751041**2 / (2 * pi) * (bending / (density * height * length**4))**0.5
    lower, upper = 0.9 * slender, slender
    assert characteristic(lower) * characteristic(upper) < 0
    for _ in range(60):
        middle = (lower + upper) / 2
        if characteristic(lower) * characteristic(middle) <= 0:
            upper = middle
        else:
            lower = middle
    return lower


def measured_frequency(degree, cells):
    """From the first to the last upward passage of the tip through zero."""
    history = run("verification/cantilever_frequency.prm", {
        "Structures/Beam/Degree": degree,
        "Structures/Beam/Mesh": f"box(0, 0, 0; 0.012, 0.08, 0.15; {cells})"})
    time, tip = history["time [s]"], history["tip displacement x [m]"]
    passages = [time[i] - tip[i] * (time[i + 1] - time[i]) / (tip[i + 1] - tip[i])
                for i in range(1, len(time) - 1) if tip[i] < 0 <= tip[i + 1]]
    return (len(passages) - 1) / (passages[-1] - passages[0])


exact = timoshenko_frequency(length=0.08, height=0.012, youngs_modulus=1e6, poissons_ratio=0, density=2700)
verification = Verification()
verification.check("Timoshenko's frequency [Hz]", exact, 5.7445, 5.7455)
for degree, cells, bound in ((2, "1, 3, 4", 0.02), (2, "1, 6, 8", 0.005), (1, "4, 16, 4", 0.05)):
    frequency = measured_frequency(degree, cells)
    verification.check(f"degree {degree}, cells {cells}: {frequency:.4f} Hz, error", frequency / exact - 1, -bound, bound)
verification.finish()
