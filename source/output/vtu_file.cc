// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/output/vtu_file.h>

#include <deal.II/base/exceptions.h>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr int tag_of_pieces = 4711;

    /**
     * Puts pieces together. An unstructured grid may have any number of
     * elements Piece; deal.II writes a file with one, and what is before and
     * after it is the same in all files of a frame.
     */
    class PiecewiseFile
    {
    public:
      explicit PiecewiseFile(const std::string &path)
        : file(path)
      {}

      /** Add what is in a file of one piece; nothing if there is no text. */
      void
      append(const std::string &text)
      {
        if (text.empty())
          return;
        const auto begin = text.find("<Piece "), end = text.rfind(end_of_piece);
        AssertThrow(begin != std::string::npos && end != std::string::npos,
                    ExcInternalError());
        const auto after = end + end_of_piece.size();
        if (head.empty())
          {
            head = text.substr(0, begin);
            tail = text.substr(after);
            file.append(head);
          }
        // some ranks have no points, and nothing is lost without their pieces
        if (text.compare(begin, empty.size(), empty) != 0)
          file.append(text.substr(begin, after - begin) + "\n");
      }

      /** Return 0 or an errno. */
      int
      finish()
      {
        file.append(tail);
        return file.finish();
      }

    private:
      const std::string end_of_piece = "</Piece>",
                        empty        = "<Piece NumberOfPoints=\"0\"";
      AtomicFile  file;
      std::string head, tail;
    };

    void
    send_to_first(const std::string &text, const MPI_Comm communicator)
    {
      const int error = MPI_Send(text.data(),
                                 static_cast<int>(text.size()),
                                 MPI_CHAR,
                                 0,
                                 tag_of_pieces,
                                 communicator);
      AssertThrowMPI(error);
    }

    std::string
    receive_from(const int rank, const MPI_Comm communicator)
    {
      MPI_Status status;
      int        error = MPI_Probe(rank, tag_of_pieces, communicator, &status);
      AssertThrowMPI(error);
      int size = 0;
      error    = MPI_Get_count(&status, MPI_CHAR, &size);
      AssertThrowMPI(error);
      std::string text(size, ' ');
      error = MPI_Recv(text.data(),
                       size,
                       MPI_CHAR,
                       rank,
                       tag_of_pieces,
                       communicator,
                       MPI_STATUS_IGNORE);
      AssertThrowMPI(error);
      return text;
    }

    /** Write the pieces of all ranks; return 0 or an errno. For the first rank.
     */
    int
    collect(const std::string                              &path,
            const MPI_Comm                                  communicator,
            const unsigned int                              n_pieces,
            const std::function<std::string(unsigned int)> &make)
    {
      const int     n_ranks = Utilities::MPI::n_mpi_processes(communicator);
      PiecewiseFile file(path);
      for (unsigned int i = 0; i < n_pieces; ++i)
        {
          file.append(make(i));
          for (int rank = 1; rank < n_ranks; ++rank)
            file.append(receive_from(rank, communicator));
        }
      return file.finish();
    }
  } // namespace

  void
  write_vtu_file(const std::string                              &path,
                 const MPI_Comm                                  communicator,
                 const unsigned int                              n_pieces,
                 const std::function<std::string(unsigned int)> &make)
  {
    int error = 0;
    if (Utilities::MPI::this_mpi_process(communicator) == 0)
      error = collect(path, communicator, n_pieces, make);
    else
      for (unsigned int i = 0; i < n_pieces; ++i)
        send_to_first(make(i), communicator);
    error = Utilities::MPI::broadcast(communicator, error);
    if (error != 0)
      report_unwritable(path, error, "the frames so far are kept");
  }
} // namespace CaissonMPM
