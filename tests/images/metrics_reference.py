"""Image metrics in numpy, written from the papers with direct 2D convolutions, to check Voxray's against.

Usage: metrics_reference.py FILE...
Each FILE is a pair of linear images: width and height as uint32, then the RGB of the test and of the reference
as float32.
Prints a line "metric value" for each metric of each file, in order.
"""

import sys

import numpy as np

PIXELS_PER_DEGREE = 3840 * np.pi / 180
RGB_TO_XYZ = np.array(
    [
        [10135552 / 24577794, 8788810 / 24577794, 4435075 / 24577794],
        [2613072 / 12288897, 8788810 / 12288897, 887015 / 12288897],
        [1425312 / 73733382, 8788810 / 73733382, 70074185 / 73733382],
    ]
)
WHITE = RGB_TO_XYZ.sum(axis=1)
LUMINANCE = np.array([0.2126, 0.7152, 0.0722])


def encode_srgb(linear):
    return np.where(linear <= 0.0031308, 12.92 * linear, 1.055 * np.maximum(linear, 0) ** (1 / 2.4) - 0.055)


def decode_srgb(display):
    return np.where(display <= 0.04045, display / 12.92, ((display + 0.055) / 1.055) ** 2.4)


def convolve(plane, kernel):
    """Direct 2D correlation, edges repeated."""
    ry, rx = kernel.shape[0] // 2, kernel.shape[1] // 2
    padded = np.pad(plane, ((ry, ry), (rx, rx)), mode="edge")
    windows = np.lib.stride_tricks.sliding_window_view(padded, kernel.shape)
    return np.einsum("yxij,ij->yx", windows, kernel)


def grid(radius):
    axis = np.arange(-radius, radius + 1)
    return np.meshgrid(axis, axis)


def opponent(rgb):
    x, y, z = np.moveaxis(rgb @ RGB_TO_XYZ.T / WHITE, -1, 0)
    return np.stack([116 * y - 16, 500 * (x - y), 200 * (y - z)], axis=-1)


def rgb_of_opponent(colour):
    y = (colour[..., 0] + 16) / 116
    x = y + colour[..., 1] / 500
    z = y - colour[..., 2] / 200
    return (np.stack([x, y, z], axis=-1) * WHITE) @ np.linalg.inv(RGB_TO_XYZ).T


def hunt_lab(rgb):
    t = rgb @ RGB_TO_XYZ.T / WHITE
    x, y, z = np.moveaxis(np.where(t > (6 / 29) ** 3, np.cbrt(t), t * (29 / 6) ** 2 / 3 + 4 / 29), -1, 0)
    lightness = 116 * y - 16
    return np.stack([lightness, 5 * lightness * (x - y), 2 * lightness * (y - z)], axis=-1)


def hyab(a, b):
    d = a - b
    return np.abs(d[..., 0]) + np.hypot(d[..., 1], d[..., 2])


def sensitivity_filter(terms):
    radius = int(np.ceil(3 * np.sqrt(0.04 / (2 * np.pi**2)) * PIXELS_PER_DEGREE))
    x, y = grid(radius)
    squared = (x**2 + y**2) / PIXELS_PER_DEGREE**2
    kernel = sum(a * np.sqrt(np.pi / b) * np.exp(-np.pi**2 * squared / b) for a, b in terms)
    return kernel / kernel.sum()


def feature_filter(kind):
    sigma = 0.5 * 0.082 * PIXELS_PER_DEGREE
    x, y = grid(int(np.ceil(3 * sigma)))
    gauss = np.exp(-(x**2 + y**2) / (2 * sigma**2))
    kernel = -x * gauss if kind == "edge" else (x**2 / sigma**2 - 1) * gauss
    return np.where(kernel > 0, kernel / kernel[kernel > 0].sum(), kernel / -kernel[kernel < 0].sum())


def strength(grey, kernel):
    return np.hypot(convolve(grey, kernel), convolve(grey, kernel.T))


def flip_map(test, reference):
    """LDR-FLIP of two linear images in [0, 1]."""
    filters = [sensitivity_filter(t) for t in ([(1, 0.0047)], [(1, 0.0053)], [(34.1, 0.04), (13.5, 0.025)])]
    edge, point = feature_filter("edge"), feature_filter("point")
    labs, edges, points = [], [], []
    for image in (test, reference):
        colour = opponent(image)
        filtered = np.stack([convolve(colour[..., c], filters[c]) for c in range(3)], axis=-1)
        labs.append(hunt_lab(np.clip(rgb_of_opponent(filtered), 0, 1)))
        grey = (colour[..., 0] + 16) / 116
        edges.append(strength(grey, edge))
        points.append(strength(grey, point))

    largest = hyab(hunt_lab(np.array([0.0, 1, 0])), hunt_lab(np.array([0.0, 0, 1]))) ** 0.7
    distance = hyab(*labs) ** 0.7
    knee = 0.4 * largest
    colour = np.where(
        distance < knee, 0.95 * distance / knee, 0.95 + 0.05 * (distance - knee) / (largest - knee)
    )
    feature = np.maximum(np.abs(edges[0] - edges[1]), np.abs(points[0] - points[1]))
    return colour ** (1 - np.sqrt(feature / np.sqrt(2)))


def aces(x):
    x = 0.6 * np.maximum(x, 0)
    return np.clip(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0, 1)


def exposures(reference):
    roots = np.roots([0.36 * (2.51 - 0.85 * 2.43), 0.6 * (0.03 - 0.85 * 0.59), -0.85 * 0.14])
    target = roots.max()
    luminance = np.sort((reference @ LUMINANCE).ravel())
    start = np.log2(target / luminance[-1])
    stop = np.log2(target / np.median(luminance))
    return np.linspace(start, stop, max(2, int(np.ceil(stop - start))))


def flip_hdr_map(test, reference):
    maps = [flip_map(aces(2**e * test), aces(2**e * reference)) for e in exposures(reference)]
    return np.max(maps, axis=0)


def ssim(test, reference):
    x, y = grid(5)
    window = np.exp(-(x**2 + y**2) / (2 * 1.5**2))
    window /= window.sum()

    def valid(plane):
        return np.einsum("yxij,ij->yx", np.lib.stride_tricks.sliding_window_view(plane, window.shape), window)

    a, b = test @ LUMINANCE, reference @ LUMINANCE
    mean_a, mean_b = valid(a), valid(b)
    var_a, var_b = valid(a * a) - mean_a**2, valid(b * b) - mean_b**2
    covariance = valid(a * b) - mean_a * mean_b
    c1, c2 = 0.01**2, 0.03**2
    top = (2 * mean_a * mean_b + c1) * (2 * covariance + c2)
    return (top / ((mean_a**2 + mean_b**2 + c1) * (var_a + var_b + c2))).mean()


def metrics(test, reference):
    test_display, reference_display = (encode_srgb(np.clip(i, 0, 1)) for i in (test, reference))
    x, r = test / reference.mean(), reference / reference.mean()
    return {
        "flip": flip_hdr_map(test, reference).mean(),
        "flip_ldr": flip_map(decode_srgb(test_display), decode_srgb(reference_display)).mean(),
        "ssim": ssim(test_display, reference_display),
        "psnr_db": -10 * np.log10(((test_display - reference_display) ** 2).mean()),
        "nrmse": np.sqrt(((x - r) ** 2).mean()),
        "relmse": ((x - r) ** 2 / (r**2 + 0.01)).mean(),
        "mean_ratio": x.mean(),
    }


def read_pair(path):
    width, height = np.fromfile(path, dtype="<u4", count=2)
    values = np.fromfile(path, dtype="<f4", offset=8).astype(np.float64)
    return values.reshape(2, height, width, 3)


if __name__ == "__main__":
    for file in sys.argv[1:]:
        for name, value in metrics(*read_pair(file)).items():
            print(f"{name} {value:.17g}")
