! SPDX-License-Identifier: LGPL-2.1-or-later
!
! Linear elastic soil. PROPS: Young's modulus (Pa) and Poisson's ratio.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, &
    drpldt, stran, dstran, time, dtime, temp, dtemp, predef, dpred, cmname, &
    ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
    dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
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
  real(8) :: lambda, mu
  integer :: i

  lambda = props(1) * props(2) / ((1 + props(2)) * (1 - 2 * props(2)))
  mu = props(1) / (2 * (1 + props(2)))
  ddsdde = 0
  ddsdde(1:3, 1:3) = lambda
  do i = 1, 3
    ddsdde(i, i) = lambda + 2 * mu
  end do
  ddsdde(4, 4) = mu                        ! of the engineering shear strain
  stress = stress + matmul(ddsdde, dstran) ! tension positive: rr, zz, tt, rz
end subroutine umat
