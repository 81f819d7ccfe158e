"""Renders a simulated image of a sheet and computes the pose of the camera from it."""
import dotpose

frame = dotpose.simulate(1)[0]
fix = dotpose.Locator().locate(frame.image)
print(f"found  x {fix.x_mm:.4f} mm, y {fix.y_mm:.4f} mm, angle {fix.theta_rad:.5f} rad")
print(f"truth  x {frame.shot.x_mm:.4f} mm, y {frame.shot.y_mm:.4f} mm, "
      f"angle {frame.shot.theta_rad:.5f} rad")
print(f"{fix.dots_used} dots; wrong with a probability of at most {fix.p_wrong:.1g}")
