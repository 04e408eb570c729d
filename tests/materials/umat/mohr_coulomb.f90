! SPDX-License-Identifier: LGPL-2.1-or-later
!
! Mohr-Coulomb with a non-associated flow rule and a tension cut-off. PROPS:
! Young's modulus (Pa), Poisson's ratio, friction and dilatancy angle (degrees),
! cohesion and tension cut-off (Pa). DDSDDE is the elastic one.
!
! The return in principal stresses s1 >= s2 >= s3 is exact (Koiter 1953):
!   plane   s = trial - f / (a . D b) D b, with the flow b of (s1, s3),
!   edge    the same for the mean of the two stresses that are equal,
!   cut-off s1 = T, on the planes s_i = T alone, or on the cone besides.
module mohr_coulomb_return
  implicit none
  private
  public :: return_to_surface

  type, public :: soil
    real(8) :: lambda, mu, nu
    real(8) :: s, sd, strength  ! sin phi, sin psi, 2 c cos phi
    real(8) :: tension, minor   ! T, and s3 on the cone where s1 = T
  end type soil

contains

  pure real(8) function yield(p, major, minor)
    type(soil), intent(in) :: p
    real(8), intent(in) :: major, minor
    yield = (1 + p%s) * major - (1 - p%s) * minor - p%strength
  end function yield

  ! to a plane or an edge of the cone alone
  pure function to_cone(p, t) result(x)
    type(soil), intent(in) :: p
    real(8), intent(in) :: t(3)
    real(8) :: x(3), d(3), mean

    d = 2 * p%lambda * p%sd + 2 * p%mu * [1 + p%sd, 0d0, p%sd - 1]
    x = t - max(yield(p, t(1), t(3)), 0d0) / gradient(d(1), d(3)) * d
    if (x(2) > x(1)) then
      d(1) = (d(1) + d(2)) / 2
      mean = (t(1) + t(2)) / 2
      mean = max(yield(p, mean, t(3)), 0d0) / gradient(d(1), d(3))
      x(1) = (t(1) + t(2)) / 2 - mean * d(1)
      x(2) = x(1)
      x(3) = t(3) - mean * d(3)
    else if (x(3) > x(2)) then
      d(3) = (d(2) + d(3)) / 2
      mean = (t(2) + t(3)) / 2
      mean = max(yield(p, t(1), mean), 0d0) / gradient(d(1), d(3))
      x(1) = t(1) - mean * d(1)
      x(3) = (t(2) + t(3)) / 2 - mean * d(3)
      x(2) = x(3)
    end if
  contains
    pure real(8) function gradient(major, minor)
      real(8), intent(in) :: major, minor
      gradient = (1 + p%s) * major - (1 - p%s) * minor
    end function gradient
  end function to_cone

  pure function to_cutoff(p, t) result(x)
    type(soil), intent(in) :: p
    real(8), intent(in) :: t(3)
    real(8) :: x(3), plane_middle, fall, minor

    plane_middle = t(2) - p%nu / (1 - p%nu) * (t(1) - p%tension)
    fall = p%nu / (1 - p%nu) * (t(1) - p%tension)
    if (plane_middle > p%tension) fall = p%nu * (t(1) + t(2) - 2 * p%tension)
    minor = min(t(3) - fall, p%tension)
    x(1) = p%tension
    x(2) = min(plane_middle, p%tension)
    x(3) = minor
    if (minor < p%minor) then
      x(2) = t(2) - p%nu * (t(1) - p%tension + t(3) - p%minor)
      x(2) = max(min(x(2), p%tension), p%minor)
      x(3) = p%minor
    end if
  end function to_cutoff

  pure function return_to_surface(p, t) result(x)
    type(soil), intent(in) :: p
    real(8), intent(in) :: t(3)
    real(8) :: x(3)

    x = to_cone(p, t)
    if (x(1) > p%tension) x = to_cutoff(p, t)
  end function return_to_surface
end module mohr_coulomb_return

subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, &
    drpldt, stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, &
    ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
    dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  use mohr_coulomb_return
  implicit none
  integer, intent(in) :: ndi, nshr, ntens, nstatv, nprops
  integer, intent(in) :: noel, npt, layer, kspt, jstep(4), kinc
  character(len=80), intent(in) :: cmname
  real(8), intent(inout) :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens)
  real(8), intent(inout) :: sse, spd, scd, rpl, ddsddt(ntens), drplde(ntens)
  real(8), intent(inout) :: drpldt, pnewdt
  real(8), intent(in) :: stran(ntens), dstran(ntens), time(2), dtime, temp
  real(8), intent(in) :: dtemp, predef(1), dpred(1), props(nprops), coords(3)
  real(8), intent(in) :: drot(3, 3), celent, dfgrd0(3, 3), dfgrd1(3, 3)
  real(8), parameter :: degree = acos(-1d0) / 180
  type(soil) :: p
  integer :: i

  call set_soil()
  ddsdde = 0
  ddsdde(1:3, 1:3) = p%lambda
  do i = 1, 3
    ddsdde(i, i) = p%lambda + 2 * p%mu
  end do
  ddsdde(4, 4) = p%mu
  stress = stress + matmul(ddsdde, dstran)
  call return_in_axes()

contains

  subroutine set_soil()
    real(8) :: apex

    p%lambda = props(1) * props(2) / ((1 + props(2)) * (1 - 2 * props(2)))
    p%mu = props(1) / (2 * (1 + props(2)))
    p%nu = props(2)
    p%s = sin(props(3) * degree)
    p%sd = sin(props(4) * degree)
    p%strength = 2 * props(5) * cos(props(3) * degree)
    apex = 1d30
    if (p%strength < 2 * apex * p%s) apex = p%strength / (2 * p%s)
    p%tension = min(props(6), apex)
    p%minor = min(((1 + p%s) * p%tension - p%strength) / (1 - p%s), p%tension)
  end subroutine set_soil

  ! the hoop stress is a principal one; the other two lie in the plane
  subroutine return_in_axes()
    real(8) :: center, difference, radius, t(3), x(3), upper, lower, scale
    integer :: hoop

    center = (stress(1) + stress(2)) / 2
    difference = (stress(1) - stress(2)) / 2
    radius = sqrt(difference**2 + stress(4)**2)
    upper = center + radius
    lower = center - radius
    hoop = 2
    if (stress(3) > upper) hoop = 1
    if (stress(3) < lower) hoop = 3
    t = [max(stress(3), upper), max(min(stress(3), upper), lower), &
         min(stress(3), lower)]
    if ((1 + p%s) * t(1) - (1 - p%s) * t(3) <= p%strength &
        .and. t(1) <= p%tension) return
    x = return_to_surface(p, t)
    upper = x(merge(2, 1, hoop == 1))
    lower = x(merge(2, 3, hoop == 3))
    scale = (upper - lower) / 2 / max(radius, 1d-150)
    stress(1) = (upper + lower) / 2 + scale * difference
    stress(2) = (upper + lower) / 2 - scale * difference
    stress(3) = x(hoop)
    stress(4) = scale * stress(4)
  end subroutine return_in_axes
end subroutine umat
