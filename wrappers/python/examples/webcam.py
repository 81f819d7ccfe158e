"""Shows the images of a camera with the located dots: webcam.py [NUMBER or VIDEO]. Press any key to
exit."""
import sys

import cv2
import dotpose

source = sys.argv[1] if len(sys.argv) > 1 else "0"
camera = cv2.VideoCapture(int(source) if source.isdigit() else source)
locator = dotpose.Locator()
while camera.isOpened() and cv2.waitKey(1) < 0:
    found, frame = camera.read()
    if not found:
        break
    fix = locator.locate(cv2.cvtColor(frame, cv2.COLOR_BGR2GRAY))
    for u, v in fix.dots.round().astype(int).tolist():
        cv2.circle(frame, (u, v), 3, (0, 160, 0) if fix else (0, 0, 255))
    print(f"{fix.x_mm:.3f} mm, {fix.y_mm:.3f} mm, {fix.theta_rad:.4f} rad" if fix else fix.message)
    cv2.imshow("dotpose", frame)
