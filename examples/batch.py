"""Many pictures by the processors of this machine; what failed is listed, not raised."""

from drapery.batch import run_batch

if __name__ == "__main__":
    rows = [
        {"name": dye, "design": f"{dye} creeper:black", "view": "hero", "size": "96x128"}
        for dye in ("white", "yellow", "orange", "red")
    ]
    result = run_batch(rows, "pictures", workers=2)
    print(f"{result.total} pictures, {result.drawn} drawn, failed: {result.failed}")
